# Reads the catalogue: sets NEARMISS_QUERIES, and writes two headers, with the inputs of every query and with the function
# of `collide` for every query.

set(NEARMISS_CATALOGUE ${PROJECT_SOURCE_DIR}/impl/catalogue/catalogue.def)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${NEARMISS_CATALOGUE})

file(STRINGS ${NEARMISS_CATALOGUE} lines REGEX "^NEARMISS_QUERY\\([a-z0-9_]+\\)$")
set(NEARMISS_QUERIES "")
set(includes "// Written by CMake from impl/catalogue/catalogue.def.\n#pragma once\n")
set(functions "${includes}#include \"impl/adapters/collide_function.hpp\"\n")
set(definitions "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^NEARMISS_QUERY\\(([a-z0-9_]+)\\)$" "\\1" query ${line})
  list(APPEND NEARMISS_QUERIES ${query})
  string(APPEND includes "#include \"impl/catalogue/queries/${query}.hpp\"\n")
  string(APPEND functions "#include <collide/${query}.hpp>\n#include \"impl/catalogue/queries/${query}.hpp\"\n")
  string(APPEND definitions "NEARMISS_COLLIDE_FUNCTION(${query})\n")
endforeach()
if(NOT NEARMISS_QUERIES)
  message(FATAL_ERROR "${NEARMISS_CATALOGUE} lists no query")
endif()

set(NEARMISS_GENERATED ${PROJECT_BINARY_DIR}/generated)
file(GENERATE OUTPUT ${NEARMISS_GENERATED}/nearmiss/catalogue_inputs.hpp CONTENT "${includes}")
file(GENERATE OUTPUT ${NEARMISS_GENERATED}/nearmiss/collide_functions.hpp CONTENT
  "${functions}namespace nearmiss::adapters {\n${definitions}}\n")
