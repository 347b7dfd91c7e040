#!/usr/bin/env bash
# Adds a query of shapes that are there, and a shape of any number of vertices with a query about it, to a copy of the
# sources, only in the places that the README names. Checks that the command line, the oracle, the generator, the
# minimiser and the fuzz targets know them, that programs and plugins get cases of different lengths, and that the tests
# about queries pass. Also adds the library of docs/bring-your-own.md by the steps of that page.
# Usage: add_a_query.sh SOURCE_FOLDER
set -euo pipefail

queries="sphere_contains_point sphere_contains_polyline"
source_folder=$(cd "$1" && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

fail() {
  echo "add_a_query: $1" >&2
  exit 1
}
# insert_before FILE PATTERN TEXT: before the first line that has the pattern.
insert_before() {
  PATTERN=$2 TEXT=$3 awk '!done && index($0, ENVIRON["PATTERN"]) { print ENVIRON["TEXT"]; done = 1 }
    { print } END { exit !done }' "$copy/$1" >"$copy/log" || fail "$1 has no line with '$2'"
  cat "$copy/log" >"$copy/$1"
}

"$source_folder/cmake/sources" "$source_folder" | tar -C "$source_folder" --null --ignore-failed-read --files-from=- -cf - | tar -C "$copy" -xf -
here=$source_folder/properties/another_query

# The recipe for a query.
cp -R "$here/overlay/." "$copy"
for query in $queries; do
  echo "NEARMISS_QUERY($query)" >>"$copy/impl/catalogue/catalogue.def"
  sed -i "/^| catalogue | what it answers |$/{n;a| \`$query\` | whether a ball holds a point, or a line of segments |
}" "$copy/docs/reference/reference-api.md"
  grep -q "$query" "$copy/docs/reference/reference-api.md" || fail "docs/reference/reference-api.md has no table for a query of one's own"
  sed -i "/^| \`slide_direction\` |/a | \`$query\` | is it in the closed ball? |" "$copy/docs/reference/semantics.md"
  sed -i "\$a #include <collide/$query.hpp>" "$copy/impl/collide/include/collide/collide.hpp"
done
echo "Certified Decision sphere_contains_point(Sphere, Vec3)
Certified Decision sphere_contains_polyline(Sphere, Polyline)" >>"$copy/impl/collide/source/queries.txt"

# The recipe for a shape.
insert_before impl/collide/include/collide/shapes.hpp "}  // namespace collide" '/// The union of the segments from each vertex to the next one; a point where there is one vertex.
template <class T>
struct Polyline {
  Counted<Vec3<T>, 32> vertices{};

  static constexpr auto members() { return std::tuple(member("vertices", &Polyline::vertices, Role::position)); }
};
'
echo 'NEARMISS_SHAPE(polyline, Polyline, "polyline", no_edges, no_faces)' >>"$copy/impl/catalogue/shapes.def"
sed -i 's/collide::Segment<double>, collide::Line<double>/collide::Polyline<double>, &/' "$copy/reports/upstream/case_shapes.hpp"
insert_before reports/upstream/ask_collide.cpp "std::string operator()(const AABox<double>& b)" '  std::string operator()(const Polyline<double>& p) const {
    std::string vertices;
    for (const auto& v : p.vertices) vertices += (vertices.empty() ? "" : ", ") + of(v);
    return made("Polyline", fmt::format("{{{}, {{{{{}}}}}}}", p.vertices.count, vertices));
  }'
sed -i 's/^\( *\)case Shape::point: break;/\1case Shape::polyline:\n&/' "$copy/reports/picture/picture_shapes.cpp"
insert_before oracles/requirements.cpp "case Shape::point:" "    case Shape::polyline:"
insert_before properties/features.cpp "case Shape::plane:" "      case Shape::polyline:"

# The same preset and the same depth of the build folder: what did not change comes from the compiler cache.
build=$copy/build/release
cmake -S "$copy" -B "$build" --preset release -DNEARMISS_BENCHMARKS=OFF -DNEARMISS_CCD=OFF \
  -DNEARMISS_BULLET=OFF -DNEARMISS_ODE=OFF -DNEARMISS_ADD="$copy/docs/example-library/nearmiss.cmake" >"$copy/log" 2>&1 ||
  { cat "$copy/log"; fail "cmake refuses the new queries"; }
cmake --build "$build" --target nearmiss_cli hosts nearmiss_properties \
  fuzz_sphere_contains_point fuzz_sphere_contains_polyline >"$copy/log" 2>&1 ||
  { grep -A 8 error "$copy/log" | head -n 60; tail -n 20 "$copy/log"; fail "the new queries do not build"; }

nearmiss=$build/reports/nearmiss
export NEARMISS_CORPUS=$copy/corpus
"$nearmiss" list --json >"$copy/list.json"
for query in $queries; do
  grep -q "\"query\": *\"$query\"" "$copy/list.json" || fail "list --json does not know $query"
  grep -q "\"fuzz_target\": *\"fuzz_$query\"" "$copy/list.json" || fail "list --json has no fuzz target for $query"
  "$nearmiss" run --query "$query" --cases 20000 --seed 1 --out "$copy/run-$query" >"$copy/log" 2>&1 ||
    { cat "$copy/log"; fail "run finds violations or cannot run"; }
  "$nearmiss" relations --query "$query" --cases 2000 --seed 1 >"$copy/log" 2>&1 ||
    { cat "$copy/log"; fail "relations finds contradictions or cannot run"; }
  "$nearmiss" replay "$copy/corpus/seeds/$query/touch.json" >"$copy/log" 2>&1 || { cat "$copy/log"; fail "replay fails"; }
  "$build/fuzz/fuzz_$query" "$copy/corpus/seeds/$query/touch.json" >"$copy/log" 2>&1 ||
    { cat "$copy/log"; fail "the fuzz target does not replay the seed"; }
done

# The tests that run for the query of fixed length, and those that compare the sources and pages with the catalogue.
"$build/properties/nearmiss_properties" \
  --gtest_filter="*sphere_contains_point*:Structure.*:ReferenceTable.*:HandDerivedCases.*:Streams.*:Catalogue.*" >"$copy/log" 2>&1 ||
  { grep -A 12 -E "Failure|FAILED" "$copy/log" | tail -n 60; fail "a test fails"; }
grep -q sphere_contains_point "$copy/log" || fail "no test ran for the query"

# Programs and plugins get each case with its length. What was made before there were lengths is refused in one line.
ask=(run --query sphere_contains_polyline --cases 2000 --seed 1)
"$nearmiss" "${ask[@]}" --command "python3 $here/polylines.py 3" --subject polylines-py --out "$copy/py" >"$copy/log" 2>&1 ||
  { cat "$copy/log"; fail "a program does not answer cases of different lengths"; }
cc -shared -fPIC -I"$copy/impl/plugin" -o "$copy/polylines.so" "$here/polylines.c" -lm
"$nearmiss" "${ask[@]}" --plugin "$copy/polylines.so" --subject polylines-c --out "$copy/c" >"$copy/log" 2>&1 ||
  { cat "$copy/log"; fail "a plugin does not answer cases of different lengths"; }
cc -shared -fPIC -DVERSION=2 -I"$copy/impl/plugin" -o "$copy/before.so" "$here/polylines.c" -lm
refused() {
  local status=0
  "$nearmiss" list "$@" >"$copy/out" 2>"$copy/log" || status=$?
  if [ "$status" != 2 ] || [ "$(wc -l <"$copy/log")" != 1 ] || ! grep -q "differ in their counts of numbers" "$copy/log"; then
    cat "$copy/out" "$copy/log"
    fail "not refused in one line: $*"
  fi
}
refused --command "python3 $here/polylines.py 1"
refused --plugin "$copy/before.so"

# The added library, by the steps of docs/bring-your-own.md, in the same build.
"$copy/docs/example-library/walkthrough.sh" "$nearmiss" || fail "docs/bring-your-own.md cannot be followed"

# Mutation: a wrong comparison in each new query must be found.
sed -i 's/ <= sphere.radius/ < 2 * sphere.radius/' "$copy/impl/collide/include/collide/detail/sphere_contains_point.hpp"
sed -i 's/ > sphere.radius/ > 2 * sphere.radius/' "$copy/impl/collide/include/collide/detail/sphere_contains_polyline.hpp"
cmake --build "$build" --target nearmiss_cli hosts >"$copy/log" 2>&1 || { cat "$copy/log"; fail "the mutants do not build"; }
for query in $queries; do
  status=0
  "$nearmiss" run --query "$query" --cases 20000 --seed 1 --out "$copy/mutant-$query" >"$copy/log" 2>&1 || status=$?
  [ "$status" = 1 ] || { cat "$copy/log"; fail "the mutant of $query ends with exit code $status, not 1"; }
done

# The simplest case has one vertex: the others do not matter.
report=$(find "$copy/mutant-sphere_contains_polyline/findings" -name "*.json" | sort | sed -n 1p)
"$nearmiss" minimise "$report" --json --out "$copy/simplest" >"$copy/minimised.json" 2>"$copy/log" || status=$?
python3 - "$copy/minimised.json" <<'EOF' || { cat "$copy/minimised.json" "$copy/log"; fail "minimise keeps vertices that do not matter"; }
import json, sys
found = json.load(open(sys.argv[1]))
vertices = (found[0] if isinstance(found, list) else found)["inputs"]["polyline"]["vertices"]
sys.exit(len(vertices) != 1)
EOF
echo "add_a_query: ${queries/ / and } answer, are judged, fuzzed and replayed; a mutant of each is found"
