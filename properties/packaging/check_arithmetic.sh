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

# Options that give up IEEE 754. The compiler, its optimiser or the program's start tells of them.
is_clang=false
if [[ $("$compiler" --version) == *clang* ]]; then is_clang=true; fi

refused() { # OPTIONS
  # shellcheck disable=SC2086  # several options
  if "$compiler" -std=c++20 -O2 $1 -S -o /dev/null -I "$include_folder" "$scratch/one.cpp" 2>"$scratch/said"; then
    fail "$1 is accepted"
  fi
  grep -qE "collide needs (IEEE 754 arithmetic|constants in double)" "$scratch/said" || fail "$1 is refused for another reason"
}
echo '#include <collide/sphere_sphere_overlap.hpp>' >"$scratch/one.cpp"
refused_options=(-ffast-math -Ofast -funsafe-math-optimizations -ffinite-math-only -fno-signed-zeros
  "-fassociative-math -fno-signed-zeros -fno-trapping-math")
if $is_clang; then
  refused_options+=(-fno-honor-nans -fno-honor-infinities -ffp-model=fast)
else
  refused_options+=(-freciprocal-math -fsingle-precision-constant)
fi
for option in "${refused_options[@]}"; do refused "$option"; done

# Options of Clang that the pragmas undo: the code is the same (without fused multiply-add, -ffp-contract=fast does nothing).
if $is_clang; then
  code() { "$compiler" -std=c++20 -O2 "$@" "$scratch/all.cpp" -S -o -; }
  code -I "$include_folder" >"$scratch/plain.s"
  code -I "$include_folder" -freciprocal-math -fapprox-func -ffp-contract=fast | cmp -s "$scratch/plain.s" - ||
    fail "-freciprocal-math or -fapprox-func changes the code of a query"
  cp "$include_folder"/collide/detail/strict_*.hpp "$scratch/without/collide/detail/"
  sed -i '/float_control(precise, on)/d' "$scratch/without/collide/detail/strict_begin.hpp"
  code -I "$scratch/without" -freciprocal-math | cmp -s "$scratch/plain.s" - &&
    fail "-freciprocal-math is without effect in any case: the check looks at nothing"
fi

# Clang contracts with -ffp-contract=fast whatever a pragma says: the program ends before main.
if grep -qw fma /proc/cpuinfo; then
  echo '#include <cstdio>
int main() { std::puts("main"); }' >>"$scratch/one.cpp"
  for contract in on fast; do
    "$compiler" -std=c++20 -O2 -mfma -ffp-contract=$contract -I "$include_folder" "$scratch/one.cpp" -o "$scratch/one"
    status=0
    ("$scratch/one" >"$scratch/said" 2>"$scratch/error") 2>/dev/null || status=$?
    if $is_clang && [[ $contract == fast ]]; then
      ((status != 0)) && grep -q "compile without -ffp-contract=fast" "$scratch/error" && [[ ! -s $scratch/said ]] ||
        fail "-ffp-contract=fast is accepted"
    else
      ((status == 0)) || fail "-ffp-contract=$contract ends the program"
    fi
  done
fi
echo "check_arithmetic: $# queries"
