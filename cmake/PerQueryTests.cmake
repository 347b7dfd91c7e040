# Writes nearmiss/per_query_tests.hpp, which lists "SUITE.TEST" for each test of properties/ that runs for every query:
# the tests of the suites in INSTANTIATE_FOR_EVERY_QUERY.

file(GLOB test_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/properties/*_test.cpp)
list(SORT test_sources)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${test_sources})
set(per_query_tests "")
foreach(source IN LISTS test_sources)
  file(STRINGS ${source} marked REGEX "^INSTANTIATE_FOR_EVERY_QUERY\\([A-Za-z]+, [A-Za-z]+,")
  foreach(line IN LISTS marked)
    string(REGEX REPLACE "^INSTANTIATE_FOR_EVERY_QUERY\\([A-Za-z]+, ([A-Za-z]+),.*" "\\1" suite "${line}")
    file(STRINGS ${source} tests REGEX "^TEST_P\\(${suite}, [A-Za-z0-9]+\\) {")
    foreach(test IN LISTS tests)
      string(REGEX REPLACE "^TEST_P\\(${suite}, ([A-Za-z0-9]+)\\) {.*" "\\1" name "${test}")
      string(APPEND per_query_tests "    \"${suite}.${name}\",\n")
    endforeach()
  endforeach()
endforeach()
if(NOT per_query_tests)
  message(FATAL_ERROR "properties/ has no test for every query")
endif()
file(GENERATE OUTPUT ${NEARMISS_GENERATED}/nearmiss/per_query_tests.hpp CONTENT
"// Written by CMake from properties/*_test.cpp.
#pragma once
#include <string_view>
namespace nearmiss {
inline constexpr std::string_view per_query_tests[] = {
${per_query_tests}};
}
")
