#!/usr/bin/env bash
# Builds the fuzz targets into $OUT, in the image of the Dockerfile. Written by `nearmiss oss-fuzz`.
set -euo pipefail
@kit@export NEARMISS_ADD=$SRC/@project@/@add@ # adds the library to Nearmiss, as the subject @subject@
exec "$SRC/nearmiss/fuzz/oss-fuzz/build-targets"
