# The oracles, the judge, the codecs and the generator of another build, for fuzz targets: libraries of the build in
# NEARMISS_EXAMINER, which is brought up to date first. Its compiler may be another one with the same standard library.

if(NOT NEARMISS_LIBFUZZER)
  message(FATAL_ERROR "NEARMISS_EXAMINER is only for builds with NEARMISS_LIBFUZZER")
endif()
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)

if(NOT EXISTS ${NEARMISS_EXAMINER}/build.ninja)
  message(STATUS "Configuring ${NEARMISS_EXAMINER}")
  execute_process(COMMAND ${CMAKE_COMMAND} --preset release -B ${NEARMISS_EXAMINER}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endif()
set(corpus ${NEARMISS_EXAMINER}/corpus/libnearmiss_corpus.a)
set(oracles ${NEARMISS_EXAMINER}/oracles/libnearmiss_oracles.a)
set(subjects ${NEARMISS_EXAMINER}/libnearmiss_subjects.a)
add_custom_target(nearmiss_examiner COMMAND ${CMAKE_COMMAND} --build ${NEARMISS_EXAMINER} --target nearmiss_corpus
  BYPRODUCTS ${corpus} ${oracles} ${subjects} COMMENT "Bringing ${NEARMISS_EXAMINER} up to date")

function(nearmiss_import name file)  # LIBRARY ...
  add_library(${name} STATIC IMPORTED)
  set_target_properties(${name} PROPERTIES IMPORTED_LOCATION ${file} INTERFACE_LINK_LIBRARIES "${ARGN}")
  add_dependencies(${name} nearmiss_examiner)
endfunction()
nearmiss_import(nearmiss_oracles ${oracles} nearmiss_subjects fmt::fmt gmp mpfr)
nearmiss_import(nearmiss_corpus ${corpus} nearmiss_oracles gmpxx gmp)
# Subjects that this build does not compile (cmake/Subjects.cmake).
nearmiss_import(nearmiss_foreign_subjects ${subjects} nearmiss_catalogue nearmiss_host)
target_link_libraries(nearmiss_subjects INTERFACE nearmiss_foreign_subjects)
