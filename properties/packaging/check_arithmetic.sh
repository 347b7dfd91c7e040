#!/usr/bin/env bash
# Whether the headers of collide guard their own arithmetic, on x86-64: no operation is contracted on a target with fused
# multiply-add, and options that give up IEEE 754 are refused.
# Usage: check_arithmetic.sh INCLUDE_FOLDER COMPILER QUERY ...
set -euo pipefail

include_folder=$1 compiler=$2
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  echo "check_arithmetic: $1" >&2
  exit 1
}

bash "$(dirname "${BASH_SOURCE[0]}")/every_query.sh" "$include_folder" Fast "$@" >"$scratch/all.cpp"

fused() { # INCLUDE_FOLDER
  "$compiler" -std=c++20 -O2 -mfma -S -o - -I "$1" "$scratch/all.cpp" >"$scratch/all.s" || fail "the queries do not compile"
  grep -c 'vmul[sp][sd]' "$scratch/all.s" >/dev/null || fail "the program has no product: the check looks at nothing"
  grep -cE 'vf[n]?m(add|sub)' "$scratch/all.s" || true
}

found=$(fused "$include_folder")
((found == 0)) || fail "$found operations are contracted"

# Teeth: without the guard the compiler contracts.
cp -R "$include_folder" "$scratch/without"
echo >"$scratch/without/collide/detail/strict_begin.hpp"
echo >"$scratch/without/collide/detail/strict_end.hpp"
found=$(fused "$scratch/without")
((found > 0)) || fail "nothing is contracted without the guard either: the check looks at nothing"

# Without SIMD lanes every query compiles as well.
"$compiler" -std=c++20 -O0 -Wall -Wextra -Werror -Wno-missing-declarations -DCOLLIDE_NO_LANES -c -o "$scratch/all.o" \
  -I "$include_folder" "$scratch/all.cpp" || fail "a query does not compile with COLLIDE_NO_LANES"

for option in -ffast-math -Ofast -ffinite-math-only; do
  if "$compiler" -std=c++20 "$option" -fsyntax-only -Wfatal-errors -I "$include_folder" "$scratch/all.cpp" 2>"$scratch/said"; then
    fail "$option is accepted"
  fi
  grep -q "collide needs IEEE 754 arithmetic" "$scratch/said" || fail "$option is refused for another reason"
done
echo "check_arithmetic: $# queries"
