# benchmark_float and benchmark_double: every query and tier in one scalar, beside FCL and Bullet in the same. Each
# scalar has a program of its own since Bullet's two libraries share their symbols' names.

find_path(BULLET_INCLUDE btBulletCollisionCommon.h PATH_SUFFIXES bullet)
find_library(BULLET_COLLISION_float BulletCollision)
find_library(BULLET_MATH_float LinearMath)
find_library(BULLET_COLLISION_double BulletCollision-float64)
find_library(BULLET_MATH_double LinearMath-float64)
mark_as_advanced(BULLET_INCLUDE BULLET_COLLISION_float BULLET_MATH_float BULLET_COLLISION_double BULLET_MATH_double)
if(NOT BULLET_INCLUDE)
  message(STATUS "Bullet is not installed (libbullet-dev): the benchmarks do without it")
endif()

# The optimization that Debian builds FCL and Bullet with; everything else as in the rest of the build.
set(optimization -O2)
string(JOIN " " flags ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${optimization} -DNDEBUG -ffp-contract=off)

# One source for each query, and one that registers all contenders.
set(declarations "")
set(calls "")
set(query_sources "")
foreach(query IN LISTS NEARMISS_QUERIES)
  set(source ${NEARMISS_GENERATED}/benchmarks/${query}.cpp)
  file(GENERATE OUTPUT ${source} CONTENT
"// Written by CMake.
#include \"benchmarks/tiers.hpp\"
#include \"nearmiss/collide_functions/${query}.hpp\"
namespace nearmiss::benchmarks {
void enter_${query}() { enter_tiers<inputs::${query}<NEARMISS_SCALAR>>(\"${query}\"); }
}
")
  list(APPEND query_sources ${source})
  string(APPEND declarations "void enter_${query}();\n")
  string(APPEND calls "  enter_${query}();\n")
endforeach()
file(GENERATE OUTPUT ${NEARMISS_GENERATED}/nearmiss/benchmark_entries.hpp CONTENT
"// Written by CMake: every contender of this build.
#pragma once
namespace nearmiss::benchmarks {
${declarations}#ifdef NEARMISS_WITH_FCL
void enter_fcl();
#endif
#ifdef NEARMISS_WITH_BULLET
void enter_bullet();
#endif
inline void enter_all() {
${calls}#ifdef NEARMISS_WITH_FCL
  enter_fcl();
#endif
#ifdef NEARMISS_WITH_BULLET
  enter_bullet();
#endif
}
}
")

# Only the subject that decides the cases: the subject bullet would link Bullet in double into every program.
set(judge ${NEARMISS_GENERATED}/benchmarks/subjects.cpp)
nearmiss_write_subjects(${judge} collide_fast_double)

set_source_files_properties(fcl.cpp bullet.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # both name their shapes alike
foreach(scalar float double)
  set(target benchmark_${scalar})
  add_executable(${target} main.cpp timed_cases.cpp ${judge} ${query_sources})
  target_link_options(${target} PRIVATE -Wl,--as-needed)
  target_link_libraries(${target} PRIVATE nearmiss_corpus nearmiss_subjects benchmark::benchmark)
  if(TARGET collide::certified)
    target_link_libraries(${target} PRIVATE collide::certified)
  endif()
  target_compile_options(${target} PRIVATE ${optimization})
  target_compile_definitions(${target} PRIVATE
    NEARMISS_SCALAR=${scalar} NEARMISS_SCALAR_NAME="${scalar}" NEARMISS_BENCHMARK_FLAGS="${flags}")
  if(TARGET fcl AND scalar STREQUAL "double")  # Debian's library has the double instances alone
    target_sources(${target} PRIVATE fcl.cpp)
    target_link_libraries(${target} PRIVATE fcl Eigen3::Eigen)
    target_compile_definitions(${target} PRIVATE NEARMISS_WITH_FCL)
  endif()
  if(BULLET_INCLUDE AND BULLET_COLLISION_${scalar} AND BULLET_MATH_${scalar})
    target_sources(${target} PRIVATE bullet.cpp)
    target_include_directories(${target} SYSTEM PRIVATE ${BULLET_INCLUDE})
    target_link_libraries(${target} PRIVATE ${BULLET_COLLISION_${scalar}} ${BULLET_MATH_${scalar}})
    target_compile_definitions(${target} PRIVATE NEARMISS_WITH_BULLET
      $<$<STREQUAL:${scalar},double>:BT_USE_DOUBLE_PRECISION>)
  endif()
  nearmiss_unite(${target} 2)
endforeach()

# Runs every contender on few cases and makes the page, to test that they run, not how fast.
if(NEARMISS_TESTS AND NEARMISS_PYTHON)
  add_test(NAME Benchmarks.RunAndMakeTheirTable COMMAND ${NEARMISS_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/table
    --build ${PROJECT_BINARY_DIR} --output ${CMAKE_CURRENT_BINARY_DIR}/smoke.md --
    --cases=64 --benchmark_min_time=0.00001 --benchmark_repetitions=1)
  set_tests_properties(Benchmarks.RunAndMakeTheirTable PROPERTIES TIMEOUT 300)
  # The stored page, without its figures, is what the programs of this build write.
  add_test(NAME Pages.Benchmarks COMMAND ${NEARMISS_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/table
    --build ${PROJECT_BINARY_DIR} --check)
  set_tests_properties(Pages.Benchmarks PROPERTIES LABELS quick)
endif()
