#!/usr/bin/env bash
# Builds the fuzz targets into $OUT, in the image of the Dockerfile. Written by `nearmiss oss-fuzz`.
set -euo pipefail
exec "$SRC/nearmiss/fuzz/oss-fuzz/build-targets"
