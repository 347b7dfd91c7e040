#!/usr/bin/env bash
# Follows docs/walkthrough.md: the three mistakes of skim are found, told apart and explained, become tests, and are fixed in
# the next run.
# Usage: bugs.sh NEARMISS
set -euo pipefail

nearmiss=$(readlink -f "$1")
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
plugin=$here/../../impl/plugin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "bugs: $1" >&2
  exit 1
}
# Runs a command that ends with the given status.
expect() { # STATUS COMMAND ...
  local wanted=$1 status=0
  shift
  "$@" >out.txt 2>err.txt || status=$?
  [[ $status == "$wanted" ]] || { cat out.txt err.txt; fail "'$*' ends with exit status $status, not $wanted"; }
}
build() { # FLAG ...
  cc "$@" -shared -fPIC -I"$plugin" -I"$here" "$here/plugin.c" "$here/skim.c" -lm -o skim.so
}
test_of() { # REPORT, then flags: compiles the emitted test with the library
  local report=$1
  shift
  expect 0 "$nearmiss" emit-test --plugin ./skim.so "$report" --out bug.c
  cc "$@" -I"$plugin" -I"$here" bug.c "$here/plugin.c" "$here/skim.c" -lm -o bug
}

build
expect 1 "$nearmiss" run --plugin ./skim.so --subject skim --cases 20000 --seed 1 --out monday
expect 1 "$nearmiss" triage monday --plugin ./skim.so
grep -q '^3 signatures in ' out.txt || fail "triage does not tell three mistakes apart: $(head -1 out.txt)"
for cause in 'tolerance of about 1e-06 (length^2 speed^2)' 'tolerance of about 0.0001 (length^2)' 'wrong at every scale'; do
  tr -s ' \n' ' ' <out.txt | grep -qF "$cause" || fail "no row has the cause '$cause'"
done
mapfile -t simplest < <(sed -n 's/^ *\(monday.*\.json\)$/\1/p' out.txt)
((${#simplest[@]} == 3)) || fail "triage names ${#simplest[@]} simplest cases"
for report in "${simplest[@]}"; do
  expect 1 "$nearmiss" show --plugin ./skim.so "$report"
  test_of "$report"
  expect 1 ./bug
  test_of "$report" -DSKIM_MENDED
  expect 0 ./bug
done

build -DSKIM_MENDED
expect 0 "$nearmiss" run --plugin ./skim.so --subject skim --cases 20000 --seed 2 --out tuesday
expect 0 "$nearmiss" triage tuesday --plugin ./skim.so --baseline monday
grep -q ' 3 fixed$' out.txt || fail "the next triage does not say that three are fixed: $(head -1 out.txt)"
expect 0 "$nearmiss" diff monday tuesday
[[ $(grep -c '^gone ' out.txt) == 3 ]] || fail "diff does not list three findings as gone"
echo "bugs: three mistakes are found, told apart and explained, become tests, and are fixed"
