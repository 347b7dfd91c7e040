#!/usr/bin/env bash
# Installs collide alone, and uses it as others would.
# Usage: check_package.sh COLLIDE_FOLDER EXAMPLE_FOLDER COMPILER installed|fetched|certified|readme|version|lines
#        check_package.sh COLLIDE_FOLDER EXAMPLE_FOLDER COMPILER includes QUERY ...
set -euo pipefail

collide=$1 example=$2 compiler=$3 what=$4
shift 4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export CXX=$compiler CMAKE_GENERATOR=Ninja

fail() {
  echo "check_package: $1" >&2
  exit 1
}
# Runs a command; shows what it said only where it fails.
quietly() {
  "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "this command fails: $*"; }
}
install_collide() { # CMAKE_ARGUMENT ...
  quietly cmake -S "$collide" -B "$scratch/collide" "$@"
  quietly cmake --build "$scratch/collide"
  quietly cmake --install "$scratch/collide" --prefix "$scratch/prefix"
  if grep -rlF -e "$collide" -e "$scratch" "$scratch/prefix"; then fail "an installed file names the folder it came from"; fi
  mv "$scratch/prefix" "$scratch/moved"  # an installation may be moved
}
run_example() { # CMAKE_ARGUMENT ...
  quietly cmake -S "$example" -B "$scratch/example" "$@"
  quietly cmake --build "$scratch/example"
  "$scratch/example/scene" >"$scratch/said" || fail "the example ends with $?"
  diff "$example/expected.txt" "$scratch/said" || fail "the example says something else than expected.txt"
}

case $what in
  installed)
    install_collide -DCOLLIDE_CERTIFIED=OFF
    run_example "-DCMAKE_PREFIX_PATH=$scratch/moved"
    ;;
  fetched) run_example "-DCOLLIDE_SOURCE=$collide" ;;
  certified)
    # The library with the queries of the program alone: all of them take minutes to compile.
    queries="-DCOLLIDE_CERTIFIED_QUERIES=sphere_sphere_overlap;sphere_sphere_penetration"
    install_collide "$queries"
    for how in "-DCMAKE_PREFIX_PATH=$scratch/moved" "-DCOLLIDE_SOURCE=$collide"; do
      quietly cmake -S "$here/certified" -B "$scratch/certified" "$how" "$queries"
      quietly cmake --build "$scratch/certified"
      quietly "$scratch/certified/certified"
      rm -rf "$scratch/fetched" && mv "$scratch/certified" "$scratch/fetched"
    done
    # Without CMake, as README of collide says.
    quietly "$compiler" -std=c++20 -I "$scratch/moved/include" "$here/certified/certified.cpp" -o "$scratch/by-hand" \
      -L "$scratch"/moved/lib* -lcollide_certified -lmpfr -lgmp
    quietly "$scratch/by-hand"
    if cmake -S "$here/certified" -B "$scratch/unknown" "-DCMAKE_PREFIX_PATH=$scratch/moved" -DCOMPONENT=unknown \
      >"$scratch/log" 2>&1; then
      fail "find_package accepts a component that does not exist"
    fi
    # Where GMP is not found the package says so, and only for this component.
    gmp_folder=$(sed -n 's|^COLLIDE_gmp_INCLUDE_DIR:PATH=||p' "$scratch/fetched/CMakeCache.txt")
    if cmake -S "$here/certified" -B "$scratch/without" "-DCMAKE_PREFIX_PATH=$scratch/moved" \
      "-DCMAKE_IGNORE_PATH=$gmp_folder" >"$scratch/log" 2>&1; then
      fail "the component certified is found without GMP"
    fi
    grep -q "gmp was not found" "$scratch/log" || { cat "$scratch/log"; fail "the missing GMP is not named"; }
    # An installation of the headers alone has no such component.
    rm "$scratch"/moved/lib*/libcollide_certified.a
    if cmake -S "$here/certified" -B "$scratch/headers" "-DCMAKE_PREFIX_PATH=$scratch/moved" >"$scratch/log" 2>&1; then
      fail "the component certified is found without its library"
    fi
    grep -q "libcollide_certified[.]a" "$scratch/log" || { cat "$scratch/log"; fail "the missing library is not named"; }
    ;;
  includes)
    # The headers of queries among all that the example reads: those that it names and no other.
    "$compiler" -std=c++20 -I "$collide/include" -M "$example/scene.cpp" | grep -o 'collide/[a-z0-9_]*\.hpp' | sort -u >"$scratch/read"
    sed -n 's|^#include <\(collide/.*\.hpp\)>$|\1|p' "$example/scene.cpp" | sort -u >"$scratch/named"
    printf 'collide/%s.hpp\n' "$@" | sort -u >"$scratch/queries"
    [[ $(comm -12 "$scratch/named" "$scratch/queries" | wc -l) == 3 ]] || fail "the example does not name three queries"
    comm -12 "$scratch/read" "$scratch/queries" | diff "$scratch/named" - || fail "the example reads other queries than it names"
    ;;
  readme)
    # The first program of the README, and what the README says that it prints.
    sed -n '/^```cpp$/,/^```$/p' "$collide/README.md" | grep -v '^```' >"$scratch/first.cpp"
    [[ -s $scratch/first.cpp ]] || fail "the README has no program"
    quietly "$compiler" -std=c++20 -Wall -Wextra -Werror -I "$collide/include" "$scratch/first.cpp" -o "$scratch/first"
    "$scratch/first" >"$scratch/said"
    grep -qFxf "$scratch/said" "$collide/README.md" || { cat "$scratch/said"; fail "the README says something else"; }
    ;;
  version)
    install_collide -DCOLLIDE_CERTIFIED=OFF
    printf '#include <collide/version.hpp>\nCOLLIDE_VERSION_MAJOR.COLLIDE_VERSION_MINOR.COLLIDE_VERSION_PATCH\n' >"$scratch/version.cpp"
    header=$("$compiler" -E -P -I "$collide/include" "$scratch/version.cpp" | tr -d ' ' | tail -n 1)
    grep -qF "set(PACKAGE_VERSION \"$header\")" "$scratch"/moved/share/cmake/collide/collideConfigVersion.cmake ||
      fail "CMake's version is not $header, that of the header"
    grep -q "^## $header$" "$collide/CHANGELOG.md" || fail "CHANGELOG.md has no section $header"
    ;;
  lines)
    # Version 0.1 read 41,800 lines for this query; half of them were <cmath>, <algorithm> and <string>.
    count=$(echo '#include <collide/sphere_sphere_overlap.hpp>' |
      "$compiler" -std=c++20 -E -P -I "$collide/include" -x c++ - | wc -l)
    ((count > 1000 && count <= 20900)) || fail "a query reads $count lines"
    # The tier Certified is a library: its headers declare, and read no exact numbers.
    with_tier=$(printf '#include <collide/%s.hpp>\n' certified decisive sphere_sphere_overlap |
      "$compiler" -std=c++20 -E -P -I "$collide/include" -x c++ - | wc -l)
    ((with_tier > count && with_tier < count + 100)) || fail "a query reads $with_tier lines with the compiled tiers, $count without"
    ;;
  *) fail "there is no check called $what" ;;
esac
echo "check_package: $what"
