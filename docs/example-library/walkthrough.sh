#!/usr/bin/env bash
# Follows docs/bring-your-own.md with a build that has skim as a subject: the run finds the three mistakes, and what
# it prints is what the page shows. With --write it puts that into the page, as after a change of the generator;
# read then whether the words around it still fit.
# Usage: walkthrough.sh NEARMISS [--write]
set -euo pipefail

nearmiss=$(readlink -f "$1")
page=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../bring-your-own.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "walkthrough: $1" >&2
  exit 1
}

# The page's blocks of output, in order; everything but the time that it took and the name of the folder.
run=reports/runs/20260131T120000Z-1
cd "$work"
"$nearmiss" check-subject --subject skim >check.txt && fail "check-subject sees no mistake"
status=0
"$nearmiss" run --subject skim --cases 100000 --seed 1 --out "$run" >run.txt 2>&1 || status=$?
[ "$status" = 1 ] || { cat run.txt; fail "run ends with exit code $status, not 1"; }
for fault in closest_point_segment/skim-off-the-surface moving_point_sphere/skim-false-miss sphere_sphere_overlap/skim-false-hit; do
  ls "$run/findings/$fault"-*.json >/dev/null || fail "the run reports no $fault"
done
[ "$(ls "$run/findings" | wc -l)" = 3 ] || fail "findings in other queries than the three that have a mistake"

finding=$(grep -o "$run/findings/moving_point_sphere/.*json" run.txt | head -n 1)
"$nearmiss" replay --subject skim "$finding" >replay.txt && fail "replay excuses a false miss"

awk -v name="$(basename "$finding")" '
  function show(file,  line) { while ((getline line < file) > 0) print line }
  /^```text$/ { print; show(++blocks == 1 ? "check.txt" : blocks == 2 ? "run.txt" : "replay.txt"); hidden = 1; next }
  /^```$/ { hidden = 0 }
  hidden { next }
  /^\.\/nearmiss replay / { sub(/skim-[-a-z0-9]*\.json/, name) }
  { print }' "$page" >page.md
if [ "${2:-}" = --write ]; then
  cp page.md "$page"
  echo "walkthrough: written into docs/bring-your-own.md"
  exit
fi
# Without the time, and without what tells how the oracle came to its word: AGREE, WITHIN, EXACT and its stages.
lasting() {
  tr -s ' ' <"$1" | sed -E 's/ answers in [^:]*:/ answers:/; s/^(The exact stage decided).*/\1/; s/^( skim [0-9,]+) [0-9,]+ [0-9,]+ (.*) [0-9.]+ %$/\1 \2/'
}
diff <(lasting "$page") <(lasting page.md) || fail "docs/bring-your-own.md shows something else (walkthrough.sh NEARMISS --write)"
echo "walkthrough: the three mistakes are found, as the page shows"
