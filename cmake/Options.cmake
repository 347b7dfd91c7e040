# Options of the build. Also fixes the floating-point environment, for all targets.

option(NEARMISS_TESTS "Build the tests" ON)
option(NEARMISS_FCL "Build FCL as a subject, where it is installed" ON)
option(NEARMISS_CCD "Build libccd as a subject, where it is installed" ON)
option(NEARMISS_BULLET "Build Bullet as a subject, where it is installed" ON)
option(NEARMISS_ODE "Build ODE as a subject, where it is installed" ON)
set(NEARMISS_ADD "" CACHE STRING "CMake files that add libraries of your own, separated by semicolons; see docs/bring-your-own.md")
option(NEARMISS_D3 "Draw pages with D3, where it is installed" ON)
option(NEARMISS_THREE "Draw scenes with three.js, where it is installed" ON)
option(NEARMISS_UNITY "Compile several sources as one unit: a fresh build takes about half the processor time" ON)
option(NEARMISS_WERROR "Treat warnings as errors" OFF)
set(NEARMISS_SANITIZE "" CACHE STRING "Sanitizers, separated by commas: address,undefined")
option(NEARMISS_COVERAGE "Instrument for coverage" OFF)
option(NEARMISS_LIBFUZZER "Link fuzz targets with libFuzzer (clang only); otherwise with a plain main" OFF)
option(NEARMISS_FUZZ_SHARED "Link fuzz targets with one shared library; otherwise each target is complete in itself" ON)
set(NEARMISS_FUZZING_ENGINE "" CACHE STRING "With NEARMISS_LIBFUZZER: the linker's argument for another engine (a flag or a library). Builds fuzz targets alone; the compiler and its flags must bring the engine's instrumentation, as in fuzz/oss-fuzz")
set(NEARMISS_EXAMINER "" CACHE PATH "With NEARMISS_LIBFUZZER: the folder of a release build. Fuzz targets link its oracles and codecs; otherwise these are compiled here")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# ccache hashes paths below the source folder as relative paths, so that another clone, or the copy that
# properties/another_query builds, can use the objects of this build.
find_program(NEARMISS_CCACHE ccache)
if(NEARMISS_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_IGNOREOPTIONS=-ffile-prefix-map=* ${NEARMISS_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

# Sets `share` to one of 0 ... shares - 1 that follows from the name alone: a new name changes one share.
function(nearmiss_share_of name shares share)
  string(MD5 hash ${name})
  string(SUBSTRING ${hash} 0 4 hash)
  math(EXPR number "0x${hash} % ${shares}")
  set(${share} ${number} PARENT_SCOPE)
endfunction()

# Compiles the sources of `target` as `units` units. A source's unit follows from its name alone: a new source changes one
# unit, and ccache keeps the others.
function(nearmiss_unite target units)
  if(NOT NEARMISS_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME)
    nearmiss_share_of(${name} ${units} unit)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP unit_${unit})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # g++ takes a source that a unit includes for a header, where an unnamed namespace would be a mistake.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# Compiles `target` with few optimisations: for code that mostly waits for subjects, oracles or programs, where more of them
# take longer than they save. A debug build does not optimise such a target: with the sanitizers the compiler then takes half of
# the time or less.
function(nearmiss_compile_for_a_short_wait target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> $<$<CONFIG:Debug>:-O0>)
endfunction()

# Warnings, and floating point according to IEEE 754. A contraction (a * b + c with one rounding) or a reassociation would
# change the results of a tier and break the bounds of intervals, so that results would depend on the compiler.
# oracles/environment.cpp checks the environment at build time and at start.
add_library(nearmiss_flags INTERFACE)
target_compile_options(nearmiss_flags INTERFACE
  -Wall -Wextra -Wshadow -Wno-unknown-pragmas
  -ffp-contract=off -fno-fast-math
  -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=  # __FILE__ of another clone is the same
  $<$<BOOL:${NEARMISS_WERROR}>:-Werror>
  $<$<BOOL:${NEARMISS_COVERAGE}>:--coverage>)
target_link_options(nearmiss_flags INTERFACE $<$<BOOL:${NEARMISS_COVERAGE}>:--coverage>)
if(NEARMISS_SANITIZE)
  set(sanitized -fsanitize=${NEARMISS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(nearmiss_flags INTERFACE -fsanitize=${NEARMISS_SANITIZE})
endif()
# The coverage counters of libFuzzer; only fuzz targets link its main. Without the traces of comparisons, which are for
# comparisons of whole numbers: nearly all of ours are of floating-point numbers.
if(NEARMISS_LIBFUZZER AND NOT NEARMISS_FUZZING_ENGINE)
  list(APPEND sanitized -fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp)
  target_link_options(nearmiss_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
# A target's own options come before those of what it links: an -fno-sanitize=all of its own would be without effect.
target_compile_options(nearmiss_flags INTERFACE "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:NEARMISS_EXAMINES>>>:${sanitized}>")
target_include_directories(nearmiss_flags INTERFACE ${PROJECT_SOURCE_DIR})

# Marks a target that examines and is not examined. Fuzz targets do not instrument it: they run ten times as fast, and
# libFuzzer counts only the coverage of the subjects.
function(nearmiss_examines target)
  if(NEARMISS_LIBFUZZER)
    set_target_properties(${target} PROPERTIES NEARMISS_EXAMINES ON)
  endif()
  if(NEARMISS_FUZZING_ENGINE)  # takes back every engine's instrumentation: flags of clang, and the compilers of AFL++
    target_compile_options(${target} PRIVATE -O2 -DNDEBUG -fno-profile-instr-generate -fno-coverage-mapping
      -fno-sanitize-coverage=trace-pc-guard,inline-8bit-counters,pc-table,indirect-calls,trace-cmp,trace-div,trace-gep,stack-depth)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND};-E;env;AFL_NOOPT=1;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
endfunction()
