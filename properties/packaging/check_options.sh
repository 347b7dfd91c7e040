#!/usr/bin/env bash
# Whether programs with strict warnings, and programs without exceptions, can use every query of collide in every tier.
# Usage: check_options.sh INCLUDE_FOLDER COMPILER QUERY ...
set -euo pipefail

include_folder=$1 compiler=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  echo "check_options: $1" >&2
  exit 1
}
compile() { # OPTION ...
  "$compiler" -std=c++20 -I "$include_folder" -I "$include_folder/../source" "$@"
}
# The program ends by SIGABRT and says this line alone.
aborts_with() { # PROGRAM ARGUMENT LINE
  local status=0
  # The inner shell says "Aborted" to nobody.
  (ulimit -c 0; "$1" "$2" 2>"$scratch/said"; exit $?) 2>/dev/null || status=$?
  ((status == 134)) || fail "'$2' ends with $status"
  [[ $(<"$scratch/said") == "$3" ]] || fail "'$2' says: $(<"$scratch/said")"
}

# Every header, every query in every tier, and the sources of the library. Headers alone are compiled by check_headers.sh.
library=$(cd "$include_folder/.." && pwd)
cmake -S "$library" -B "$scratch/library" -DCMAKE_CXX_COMPILER="$compiler" >"$scratch/said" || fail "the sources of the library cannot be written"
{
  for header in "$include_folder"/collide/*.hpp; do echo "#include <collide/${header##*/}>"; done
  bash "$here/every_query.sh" "$include_folder" "Fast Accurate Decisive Certified" "$@"
  for source in "$library"/source/*.cpp "$scratch"/library/source/*.cpp; do echo "#include \"$source\""; done
} >"$scratch/all.cpp"
compile -fsyntax-only -fno-exceptions -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Werror "$scratch/all.cpp" ||
  fail "the queries do not compile without exceptions, or not without a warning"

# Teeth: the headers hide no warning of the program that includes them.
printf '#include <collide/%s.hpp>\nunsigned long sign(int x) { return x; }\n' "$1" >"$scratch/caller.cpp"
if compile -fsyntax-only -Wsign-conversion -Werror "$scratch/caller.cpp" 2>"$scratch/said"; then
  fail "a conversion in the calling program is not reported"
fi

asked=(sphere_sphere_overlap.cpp sphere_sphere_penetration.cpp moving_point_triangle.cpp)
compile -fno-exceptions "$here/without_exceptions.cpp" "$library"/source/{certified,real}.cpp \
  "${asked[@]/#/$scratch/library/source/}" -o "$scratch/without" -lmpfr -lgmp ||
  fail "a program does not compile"
"$scratch/without" answers || fail "the answers without exceptions are wrong"
aborts_with "$scratch/without" batch "collide: a batch has arguments and answers of different sizes"
aborts_with "$scratch/without" shape "collide: sphere.radius is -1: it must be not negative"
aborts_with "$scratch/without" direction "collide: velocity is 0: it must be not all of x, y, z zero"
echo "check_options: $# queries"
