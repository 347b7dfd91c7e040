#!/usr/bin/env bash
# Compiles every header of collide by itself, without a warning: each includes all that it needs. Those of its library too.
# Usage: check_headers.sh INCLUDE_FOLDER COMPILER [OPTION ...]
set -euo pipefail

include_folder=$1
compiler=$2
shift 2
failed=0 count=0
for header in "$include_folder"/collide/*.hpp "$include_folder"/collide/detail/*.hpp "$include_folder"/../source/*.hpp; do
  name=${header#"$include_folder"/}
  case $name in collide/detail/strict_begin.hpp | collide/detail/strict_end.hpp) continue ;; esac # no headers by themselves: a pair around functions
  # Included twice: a header guards itself.
  printf '#include <%s>\n#include <%s>\n' "$name" "$name" |
    "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -pedantic -Werror "$@" -I "$include_folder" -x c++ - ||
    { echo "check_headers: $name does not compile alone${1+ with }$*" >&2; failed=1; }
  count=$((count + 1))
done
((count > 0)) || { echo "check_headers: no header in $include_folder/collide" >&2; exit 1; }
echo "check_headers: $count headers"
exit "$failed"
