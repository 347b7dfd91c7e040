#!/usr/bin/env bash
# Adds another query to a copy of the sources, only in the places that the README names, and checks that the command
# line, the oracle, the generator and the fuzz target know the query and that the tests about queries pass. Also adds the
# library of docs/bring-your-own.md by the steps of that page.
# Usage: add_a_query.sh SOURCE_FOLDER
set -euo pipefail

query=sphere_contains_point
source_folder=$(cd "$1" && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

fail() {
  echo "add_a_query: $1" >&2
  exit 1
}

"$source_folder/cmake/sources" "$source_folder" | tar -C "$source_folder" --null --ignore-failed-read --files-from=- -cf - | tar -C "$copy" -xf -
here=$source_folder/properties/another_query

# The recipe.
cp -R "$here/overlay/." "$copy"
echo "NEARMISS_QUERY($query)" >>"$copy/impl/catalogue/catalogue.def"
echo "Certified Decision $query(Sphere, Vec3)" >>"$copy/impl/collide/source/queries.txt"
sed -i "/^| catalogue | what it answers |$/{n;a| \`$query\` | whether a ball holds a point |
}" "$copy/docs/reference/reference-api.md"
grep -q "$query" "$copy/docs/reference/reference-api.md" || fail "docs/reference/reference-api.md has no table for a query of one's own"
sed -i "/^| \`slide_direction\` |/a | \`$query\` | is the point in the closed ball? |" "$copy/docs/reference/semantics.md"
sed -i "\$a #include <collide/$query.hpp>" "$copy/impl/collide/include/collide/collide.hpp"

# The same preset and the same depth of the build folder: what did not change comes from the compiler cache.
build=$copy/build/release
cmake -S "$copy" -B "$build" --preset release -DNEARMISS_BENCHMARKS=OFF -DNEARMISS_CCD=OFF \
  -DNEARMISS_BULLET=OFF -DNEARMISS_ODE=OFF -DNEARMISS_ADD="$copy/docs/example-library/nearmiss.cmake" >"$copy/log" 2>&1 ||
  { cat "$copy/log"; fail "cmake refuses the new query"; }
cmake --build "$build" --target nearmiss_cli hosts nearmiss_properties "fuzz_$query" >"$copy/log" 2>&1 ||
  { tail -n 40 "$copy/log"; fail "the new query does not build"; }

nearmiss=$build/reports/nearmiss
export NEARMISS_CORPUS=$copy/corpus
"$nearmiss" list --json >"$copy/list.json"
grep -q "\"query\": *\"$query\"" "$copy/list.json" || fail "list --json does not know $query"
grep -q "\"fuzz_target\": *\"fuzz_$query\"" "$copy/list.json" || fail "list --json has no fuzz target for $query"
"$nearmiss" run --query "$query" --cases 20000 --seed 1 --out "$copy/run" >"$copy/log" 2>&1 ||
  { cat "$copy/log"; fail "run finds violations or cannot run"; }
"$nearmiss" replay "$copy/corpus/seeds/$query/touch.json" >"$copy/log" 2>&1 || { cat "$copy/log"; fail "replay fails"; }
"$build/fuzz/fuzz_$query" "$copy/corpus/seeds/$query/touch.json" >"$copy/log" 2>&1 ||
  { cat "$copy/log"; fail "the fuzz target does not replay the seed"; }

# The tests that run for the query, and those that compare the sources and pages with the catalogue.
"$build/properties/nearmiss_properties" \
  --gtest_filter="*$query*:Structure.*:ReferenceTable.*:HandDerivedCases.*:Streams.*:Catalogue.*" >"$copy/log" 2>&1 ||
  { grep -A 12 -E "Failure|FAILED" "$copy/log" | tail -n 60; fail "a test fails"; }
grep -q "$query" "$copy/log" || fail "no test ran for the query"

# The added library, by the steps of docs/bring-your-own.md, in the same build.
"$copy/docs/example-library/walkthrough.sh" "$nearmiss" || fail "docs/bring-your-own.md cannot be followed"

# Mutation: a wrong comparison in the new query must be found.
sed -i 's/ <= sphere.radius/ < 2 * sphere.radius/' "$copy/impl/collide/include/collide/detail/$query.hpp"
cmake --build "$build" --target nearmiss_cli hosts >"$copy/log" 2>&1 || { cat "$copy/log"; fail "the mutant does not build"; }
status=0
"$nearmiss" run --query "$query" --cases 20000 --seed 1 --out "$copy/mutant" >"$copy/log" 2>&1 || status=$?
[ "$status" = 1 ] || { cat "$copy/log"; fail "the mutant ends with exit code $status, not 1"; }
echo "add_a_query: $query answers, is judged, fuzzed and replayed; a mutant of it is found"
