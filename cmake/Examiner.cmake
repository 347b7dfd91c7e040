# The catalogue, the oracles, the judge, the codecs and the generator of another build, for fuzz targets: libraries of the
# build in NEARMISS_EXAMINER, which is brought up to date first. Its compiler may be another one with the same standard
# library.

if(NOT NEARMISS_LIBFUZZER)
  message(FATAL_ERROR "NEARMISS_EXAMINER is only for builds with NEARMISS_LIBFUZZER")
endif()
if(NOT EXISTS ${NEARMISS_EXAMINER}/build.ninja)
  message(STATUS "Configuring ${NEARMISS_EXAMINER}")
  execute_process(COMMAND ${CMAKE_COMMAND} --preset release -B ${NEARMISS_EXAMINER}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endif()
set(archives libnearmiss_catalogue.a corpus/libnearmiss_corpus.a oracles/libnearmiss_oracles.a libnearmiss_subjects.a)
list(TRANSFORM archives PREPEND ${NEARMISS_EXAMINER}/)
add_custom_target(nearmiss_examiner COMMAND ${CMAKE_COMMAND} --build ${NEARMISS_EXAMINER} --target nearmiss_corpus nearmiss_subjects
  BYPRODUCTS ${archives} COMMENT "Bringing ${NEARMISS_EXAMINER} up to date")

function(nearmiss_import name file)  # LIBRARY ...
  add_library(${name} STATIC IMPORTED GLOBAL)
  set_target_properties(${name} PROPERTIES
    IMPORTED_LOCATION ${NEARMISS_EXAMINER}/${file} INTERFACE_LINK_LIBRARIES "${ARGN}")
  add_dependencies(${name} nearmiss_examiner)
endfunction()

# Imports the libraries. The subjects of this build are known by then; the others come from the other build
# (cmake/Subjects.cmake).
function(nearmiss_import_examiner)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  nearmiss_import(nearmiss_oracles oracles/libnearmiss_oracles.a nearmiss_wall fmt::fmt gmp mpfr)
  nearmiss_import(nearmiss_corpus corpus/libnearmiss_corpus.a nearmiss_oracles gmpxx gmp)
  get_property(libraries GLOBAL PROPERTY NEARMISS_FOREIGN_LIBRARIES)
  nearmiss_import(nearmiss_foreign_subjects libnearmiss_subjects.a nearmiss_catalogue nearmiss_host ${libraries})
  target_link_libraries(nearmiss_subjects INTERFACE nearmiss_foreign_subjects)
endfunction()
