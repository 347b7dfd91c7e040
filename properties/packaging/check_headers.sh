#!/usr/bin/env bash
# Compiles every header of collide by itself, without a warning: each includes all that it needs. Does the same without
# SIMD lanes.
# Usage: check_headers.sh INCLUDE_FOLDER COMPILER
set -euo pipefail

include_folder=$1
compiler=$2
failed=0 count=0
for header in "$include_folder"/collide/*.hpp "$include_folder"/collide/detail/*.hpp; do
  name=collide/${header##*/collide/}
  case $name in collide/detail/strict_*) continue ;; esac # no headers by themselves: a pair around functions
  for lanes in "" -DCOLLIDE_NO_LANES; do
    # Included twice: a header guards itself.
    printf '#include <%s>\n#include <%s>\n' "$name" "$name" |
      "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wshadow -pedantic -Werror $lanes -I "$include_folder" -x c++ - ||
      { echo "check_headers: $name does not compile alone $lanes" >&2; failed=1; }
  done
  count=$((count + 1))
done
((count > 0)) || { echo "check_headers: no header in $include_folder/collide" >&2; exit 1; }
echo "check_headers: $count headers"
exit "$failed"
