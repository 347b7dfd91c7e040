#!/usr/bin/env bash
# Prints a program that contains every query in some tiers and in both scalars, called by a pointer to it, and every batch form.
# Usage: every_query.sh INCLUDE_FOLDER "TIER ..." QUERY ...
set -euo pipefail

include_folder=$1 tiers=$2
shift 2
fail() {
  echo "every_query: $1" >&2
  exit 1
}

batches=$(sed -nE 's/^void ([a-z_]+)\(SoaView.*/\1/p' "$include_folder/collide/batch.hpp")
[[ -n $batches ]] || fail "batch.hpp has no batch form"

echo '#include <collide/batch.hpp>'
echo '#include <collide/collide.hpp>'
for tier in $tiers; do
  case $tier in Decisive | Certified) echo "#include <collide/${tier,,}.hpp>" ;; esac
done
echo 'namespace collide {'
for query in "$@"; do
  # The parameters, from the declaration in the header; the first overload is enough.
  parameters=$(sed -n "/^\[\[nodiscard\]\].* $query(/,/noexcept/{p;/noexcept/q}" "$include_folder/collide/$query.hpp" |
    tr '\n' ' ' | sed -E "s/.* $query\((.*)\) noexcept.*/\1/; s/ = [^,)]*//g")
  [[ -n $parameters ]] || parameters=$(sed -nE "s/^COLLIDE_(OVERLAP[A-Z_]*|SIGNED_DISTANCE[A-Z_]*)\(([0-9]+, )?$query, ([A-Za-z0-9]+), ([a-z0-9]+), ([A-Za-z0-9]+), ([a-z0-9]+)\)/const \3<T>\& \4, const \5<T>\& \6/p" \
    "$include_folder/collide/$query.hpp")
  [[ -n $parameters ]] || fail "the declaration of $query was not found"
  names=$(sed -E 's/([^,]*[ &])([a-z0-9_]+)(,|$)/\2\3/g; s/ +//g' <<<"$parameters")
  for scalar in float double; do
    concrete=$(sed -E "s/<T>/<$scalar>/g; s/\bT\b/$scalar/g" <<<"$parameters")
    for tier in $tiers; do
      echo "auto call_${query}_${scalar}_$tier($concrete) { return $query<$tier>($names); }"
    done
  done
done
for query in $batches; do
  for scalar in float double; do echo "auto batch_of_${query}_$scalar = &batch::$query<$scalar>;"; done
done
echo '}'
