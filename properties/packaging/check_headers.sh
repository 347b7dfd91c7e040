#!/usr/bin/env bash
# Compiles every header of collide by itself, without a warning: each includes all that it needs.
# Usage: check_headers.sh INCLUDE_FOLDER COMPILER
set -euo pipefail

include_folder=$1
compiler=$2
failed=0 count=0
for header in "$include_folder"/collide/*.hpp; do
  name=collide/${header##*/}
  # Included twice: a header guards itself.
  printf '#include <%s>\n#include <%s>\n' "$name" "$name" |
    "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wshadow -pedantic -Werror -I "$include_folder" -x c++ - ||
    { echo "check_headers: $name does not compile alone" >&2; failed=1; }
  count=$((count + 1))
done
((count > 0)) || { echo "check_headers: no header in $include_folder/collide" >&2; exit 1; }
echo "check_headers: $count headers"
exit "$failed"
