#!/usr/bin/env bash
# Builds the fuzz targets to the contract of OSS-Fuzz and ClusterFuzzLite, and everything that their engines read beside a
# target. Their base image sets the variables; fuzz/oss-fuzz/test and fuzz/afl/build set them in the same way.
# https://google.github.io/oss-fuzz/getting-started/new-project-guide/#buildsh
#
# Required:
#   CC CXX CFLAGS CXXFLAGS   the compilers and their flags, with the sanitizer's and the engine's
#   LIB_FUZZING_ENGINE       the linker's argument for the engine
#   OUT                      the folder for the results: fuzz_QUERY, fuzz_QUERY_seed_corpus.zip, .dict, .options
#   WORK                     a folder for the build
# Optional:
#   NEARMISS_FUZZ_QUERIES    the queries to build targets for, separated by spaces; "protocol" stands for fuzz_protocol.
#                            Without it: all
#   NEARMISS_ADD             a CMake file that adds the subjects to ask (docs/bring-your-own.md); the targets then ask
#                            these instead of the tiers of collide
#   NEARMISS_CMAKE           more arguments for CMake, separated by spaces
#   NEARMISS_JOBS            the number of compilers at a time
#
# Exit status: 2 with one line where a variable is missing or wrong; that of the failed command otherwise.
set -euo pipefail

top=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)

stop() {
  printf 'build.sh: %s\n' "$*" >&2
  exit 2
}

for variable in CC CXX CFLAGS CXXFLAGS LIB_FUZZING_ENGINE OUT WORK; do
  [[ -v $variable ]] || stop "\$$variable is not set: the base image of OSS-Fuzz sets it"
done
for tool in cmake ninja zip; do
  command -v "$tool" >/dev/null || stop "needs $tool"
done
[[ -d $OUT && -d $WORK ]] || stop "\$OUT and \$WORK must be folders: $OUT, $WORK"
[[ -z ${NEARMISS_ADD-} || -f $NEARMISS_ADD ]] || stop "\$NEARMISS_ADD names $NEARMISS_ADD, and there is no such file"

known=$(sed -n 's/^NEARMISS_QUERY(\([a-z0-9_]*\))$/\1/p' "$top/impl/catalogue/catalogue.def")
read -r -a queries <<<"${NEARMISS_FUZZ_QUERIES-${known//$'\n'/ } protocol}"
((${#queries[@]})) || stop "\$NEARMISS_FUZZ_QUERIES is empty"
for query in "${queries[@]}"; do
  [[ $query == protocol ]] || grep -qx "$query" <<<"$known" || stop "\$NEARMISS_FUZZ_QUERIES names '$query', which is no query"
done

# GMP and MPFR are linked into the targets: the machines that run them have only the C library.
build=$WORK/nearmiss
mkdir -p "$build/static"
for library in gmp gmpxx mpfr; do
  file=$("$CXX" "-print-file-name=lib$library.a")
  [[ -f $file ]] || stop "needs lib$library.a (libgmp-dev, libmpfr-dev)"
  ln -sf "$file" "$build/static/"
done

options=(-G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_FLAGS_RELWITHDEBINFO= -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=
  "-DCMAKE_EXE_LINKER_FLAGS=-L$build/static" "-DCMAKE_MODULE_PATH=$top/fuzz/oss-fuzz/cmake"
  -DNEARMISS_LIBFUZZER=ON "-DNEARMISS_FUZZING_ENGINE=$LIB_FUZZING_ENGINE" -DNEARMISS_FUZZ_SHARED=OFF -DNEARMISS_TESTS=OFF
  -DNEARMISS_FCL=OFF -DNEARMISS_CCD=OFF -DNEARMISS_BULLET=OFF -DNEARMISS_ODE=OFF)
if [[ -n ${NEARMISS_ADD-} ]]; then options+=("-DNEARMISS_ADD=$NEARMISS_ADD" -DNEARMISS_FUZZ_SUBJECTS=added); fi
read -r -a more <<<"${NEARMISS_CMAKE-}"

# Objects of AFL++'s compilers depend on its variables too.
export CCACHE_NAMESPACE
CCACHE_NAMESPACE=$(env | grep '^AFL_' | LC_ALL=C sort || true)

cmake -S "$top" -B "$build" "${options[@]}" "${more[@]}"
targets=("${queries[@]/#/fuzz_}")
cmake --build "$build" --parallel "${NEARMISS_JOBS:-$(nproc)}" --target "${targets[@]}" seeds_to_bytes engine_files

# Zips the files of a folder, without the folder.
pack() { # ZIP FOLDER
  rm -f "$1"
  (cd "$2" && find . -maxdepth 1 -type f | LC_ALL=C sort | zip -q -X "$1" -@)
}

export ASAN_OPTIONS=detect_leaks=0 # cannot trace processes in a container
OUT=$(cd "$OUT" && pwd)
for query in "${queries[@]}"; do
  seeds=$top/fuzz/protocol
  if [[ $query == protocol ]]; then
    printf '[libfuzzer]\nmax_len = 4096\ntimeout = 10\n' >"$OUT/fuzz_protocol.options"
  else
    seeds=$build/seeds/$query
    "$build/fuzz/seeds_to_bytes" "$query" "$seeds"
    "$build/fuzz/engine_files" "$query" "$OUT"
  fi
  cp "$build/fuzz/fuzz_$query" "$OUT/"
  pack "$OUT/fuzz_${query}_seed_corpus.zip" "$seeds"
done
