#!/usr/bin/env bash
# Runs every command with its default folders in a copy of the clone, and then what reads the sources there: no command
# changes what is a source, and the tests that read the sources pass.
# Usage: check_defaults.sh SOURCES NEARMISS PROPERTIES PLUGIN
set -euo pipefail

sources=$(cd "$1" && pwd) nearmiss=$2 properties=$3 plugin=$4
command -v git >/dev/null || { echo "check_defaults: needs git" >&2; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
copy=$scratch/clone
mkdir "$copy"

fail() {
  echo "check_defaults: $1" >&2
  exit 1
}

"$sources/cmake/sources" "$sources" | tar -C "$sources" --null --ignore-failed-read --files-from=- -cf - | tar -C "$copy" -xf -
cd "$copy"
unset GIT_DIR GIT_INDEX_FILE GIT_WORK_TREE NEARMISS_RUNS NEARMISS_CORPUS
git -c init.defaultBranch=main init -q
git add -A
cmake/sources >"$scratch/before"
export NEARMISS_SOURCES=$copy

asked=()
run() { # COMMAND [ARGUMENT ...]
  asked+=("$1")
  local status=0 most=1
  [[ $1 == nightly ]] && most=2 # on a slow machine the time is over before the first case
  "$nearmiss" "$@" >"$scratch/said" 2>&1 </dev/null || status=$?
  ((status <= most)) || { cat "$scratch/said" >&2; fail "nearmiss $* ends with $status"; }
}

query=sphere_sphere_overlap
run help
run list --why
run completion bash
run run --plugin "$plugin" -s skim -q "$query" --cases 20000 --seed 1
report=$(find reports/runs -path '*/findings/*.json' | sort | head -n 1)
folder=${report%%/findings/*}
[[ -n $report ]] || fail "the run has no finding"
foreign=(--plugin "$plugin")
run check-subject "${foreign[@]}" -s skim -q "$query"
run replay "$report" "${foreign[@]}"
run show "$report" "${foreign[@]}"
run minimise "$report" "${foreign[@]}" --questions 20
run explain "$report" "${foreign[@]}" --questions 20
run triage "$folder" "${foreign[@]}" --minutes 0.01
run diff "$folder" "$folder"
run emit-test "$report" "${foreign[@]}"
run upstream-report "$report" "${foreign[@]}"
run promote "$report" "${foreign[@]}" --note "Balls that are apart touch, by a slack."
run relations -s collide-fast-float -q "$query" --cases 3
run extremes -s collide-fast-float -q "$query" --cases 1
run sweep -q "$query" --number sphere1.radius --from 1 --to 1.00001
run trade -s collide-fast-float -q "$query" --cases 10
run builds --plugin "$plugin" --plugin "$plugin" -q "$query" --cases 10
run scene advise driving --cases 20
run scene verify "$(find reports/runs -name profile.json)" --cases 10
run nightly --minutes 0.01
printf '{"query": "%s", "scalar": "float", "values": [0, 0, 0, 1, 3, 0, 0, 1]}\n' "$query" >"$scratch/trace.jsonl"
run truth "$scratch/trace.jsonl"
run import jsonl "$scratch/trace.jsonl" --scene "$scratch/mine.json"
run oss-fuzz --subject skim --add docs/example-library/nearmiss.cmake --out "$scratch/kit"
status=0
"$nearmiss" render reports/runs --seconds 0 >"$scratch/said" 2>&1 || status=$?
((status == 0)) || grep -q "this build writes no pages" "$scratch/said" || { cat "$scratch/said" >&2; fail "render fails"; }
asked+=(render)

# Bisect writes into a temporary folder alone; its test is another (bisect_test.cpp).
"$nearmiss" help | sed -n '/^COMMANDS$/,/^$/s/^    \([a-z-]*\) .*/\1/p' | sort >"$scratch/commands"
printf '%s\n' "${asked[@]}" bisect | sort -u | diff "$scratch/commands" - || fail "a command is not run here"

# What promote stored is meant to be there; nothing else.
git diff --quiet || fail "a source is changed: $(git diff --name-only | head -n 3)"
stored=$(git ls-files --others --exclude-standard)
[[ $stored == corpus/regressions/*.json && $stored != *$'\n'* ]] || fail "git sees more than one stored case: $(head -n 3 <<<"$stored")"
cmake/sources | cmp - "$scratch/before" || fail "the sources are others than before"

tests='Structure.*:ReferenceTable.*:Catalogue.*'
"$properties" --gtest_filter="$tests" >"$scratch/said" 2>&1 || { tail -n 40 "$scratch/said" >&2; fail "a test of the sources fails"; }
grep -q 'Structure.IncludesPointToTheLeft' "$scratch/said" || fail "the tests of the sources were not run"
if command -v python3 >/dev/null; then
  PYTHONDONTWRITEBYTECODE=1 python3 corpus/known-bugs --check || fail "docs/measured/known-bugs.md would change"
fi

# An export has no folder .git: its sources are the same, and the stored case.
rm -rf .git
diff <(tr '\0' '\n' <"$scratch/before" | sort) <(cmake/sources | tr '\0' '\n' | sort) >"$scratch/more" || true
[[ $(grep -c '^[<>]' "$scratch/more") == 1 ]] || { cat "$scratch/more" >&2; fail "an export has other sources"; }
"$properties" --gtest_filter='Structure.*' >"$scratch/said" 2>&1 || { tail -n 40 "$scratch/said" >&2; fail "a test of an export fails"; }
echo "check_defaults: ${#asked[@]} commands"
