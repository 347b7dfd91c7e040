#!/usr/bin/env bash
# Compiler flags that a subject's library requires apply to that subject's source alone.
# Usage: check.sh SOURCES
set -euo pipefail

build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
cmake -S "$1" -B "$build" -G Ninja -DNEARMISS_ADD="$1/properties/subject_flags/subjects.cmake" -DNEARMISS_TESTS=OFF \
  -DNEARMISS_BENCHMARKS=OFF >"$build/configure.txt" 2>&1 || { cat "$build/configure.txt"; exit 1; }

for flag in ' -ffast-math ' '-DONLY_FOR_THE_FAST_ONE '; do
  with=$(grep '"command"' "$build/compile_commands.json" | grep -e "$flag" | grep -o '[^ ]*\.cpp"' || true)
  case $with in
    */subjects/fast_one.cpp\") ;;
    *) echo "compiled with$flag: ${with:-nothing}" >&2; exit 1 ;;
  esac
done
grep -q 'subjects/other_one.cpp' "$build/compile_commands.json" || { echo "the other subject is missing" >&2; exit 1; }
echo "the flags are those of one subject alone"
