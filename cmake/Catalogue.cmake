# Reads the catalogue: sets NEARMISS_QUERIES and writes the header that includes every query.

set(NEARMISS_CATALOGUE ${PROJECT_SOURCE_DIR}/oracles/catalogue.def)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${NEARMISS_CATALOGUE})

file(STRINGS ${NEARMISS_CATALOGUE} lines REGEX "^NEARMISS_QUERY\\([a-z0-9_]+\\)$")
set(NEARMISS_QUERIES "")
set(includes "// Written by CMake from oracles/catalogue.def.\n#pragma once\n")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^NEARMISS_QUERY\\(([a-z0-9_]+)\\)$" "\\1" query ${line})
  list(APPEND NEARMISS_QUERIES ${query})
  string(APPEND includes "#include <collide/${query}.hpp>\n")
endforeach()
if(NOT NEARMISS_QUERIES)
  message(FATAL_ERROR "${NEARMISS_CATALOGUE} lists no query")
endif()

set(NEARMISS_GENERATED ${PROJECT_BINARY_DIR}/generated)
file(GENERATE OUTPUT ${NEARMISS_GENERATED}/nearmiss/catalogue_inputs.hpp CONTENT "${includes}")
