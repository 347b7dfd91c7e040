#!/usr/bin/env bash
# Builds programs with the files of a profile: one that uses its queries, and ones that must not compile.
# Usage: check_profile.sh NEARMISS COLLIDE_FOLDER COMPILER
set -euo pipefail

nearmiss=$1 collide=$2 compiler=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export CXX=$compiler CMAKE_GENERATOR=Ninja

fail() {
  echo "check_profile: $1" >&2
  exit 1
}
# Runs a command; shows what it said only where it fails.
quietly() {
  "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "this command fails: $*"; }
}
# Expects that a program does not compile, and that the compiler says so in these words.
refuses() { # WORDS CALL
  printf '#include <collide_profile.hpp>\nint main() { %s }\n' "$2" >"$scratch/bad.cpp"
  if "$compiler" -std=c++20 -fsyntax-only -I "$scratch/out" -I "$collide/include" "$scratch/bad.cpp" 2>"$scratch/log"; then
    fail "this compiles: $2"
  fi
  grep -qF "$1" "$scratch/log" || { cat "$scratch/log" >&2; fail "the compiler does not say: $1"; }
}

# The tier that advise chooses follows from times; one tier and generous cases make the profile the same everywhere.
"$nearmiss" scene advise recorded --cases 20 -s collide-accurate-double --out "$scratch/out" >"$scratch/log" 2>&1 ||
  [[ $? == 1 ]] || { cat "$scratch/log" >&2; fail "scene advise fails"; }
grep -q '"subject": "collide-accurate-double"' "$scratch/out/profile.json" || fail "the profile has no query"

cat >"$scratch/program.cpp" <<'END'
#include <collide_profile.hpp>
#include <cstdio>

int main() {
  const collide::Sphere<double> ball{.center = {-4, 0, 0}, .radius = 0.5}, wall{.center = {4, 0, 0}, .radius = 0.5};
  const collide::Box<double> crate{.center = {2, 0, 0}, .half = {1.5, 1, 2}};
  const auto impact = collide_profile::moving_sphere_box(ball, collide::Vec3<double>{2, 0, 0}, crate);
  std::printf("%g %d\n", impact.time, int(collide_profile::sphere_sphere_overlap(ball, wall).yes()));
}
END
cat >"$scratch/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(program LANGUAGES CXX)
include(out/collide_profile.cmake)
add_executable(program program.cpp)
target_link_libraries(program PRIVATE collide_profile)
END
quietly cmake -S "$collide" -B "$scratch/collide"
quietly cmake --install "$scratch/collide" --prefix "$scratch/prefix"
for how in "-DCMAKE_PREFIX_PATH=$scratch/prefix" "-DCOLLIDE_SOURCE=$collide"; do
  rm -rf "$scratch/build"
  quietly cmake -S "$scratch" -B "$scratch/build" "$how"
  quietly cmake --build "$scratch/build"
  [[ $("$scratch/build/program") == "2 0" ]] || fail "the program prints $("$scratch/build/program")"
done

# The headers of the profile's queries, and of no other.
"$compiler" -std=c++20 -I "$scratch/out" -I "$collide/include" -M "$scratch/program.cpp" >"$scratch/read"
grep -q 'collide/moving_sphere_box\.hpp' "$scratch/read" || fail "the profile does not include its query"
if grep -q 'collide/box_box_overlap\.hpp' "$scratch/read"; then fail "the profile includes a query that it does not have"; fi

ball='collide::Sphere<double>{}' box='collide::Box<double>{}'
refuses "box_box_overlap is not in the profile of the scene recorded: add it to the scene and run 'nearmiss scene advise'" \
  "collide_profile::box_box_overlap($box, $box);"
refuses "sphere_sphere_overlap: the profile of the scene recorded computes in double" \
  "(void)collide_profile::sphere_sphere_overlap(collide::Sphere<float>{}, collide::Sphere<float>{});"
refuses "" "(void)collide::box_box_overlap($box, $box);"
refuses "" "collide_profile::box_box_overlap($ball, $ball);"
echo "check_profile: passed"
