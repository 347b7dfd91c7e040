# nearmiss_add_subject(NAME HEADER ADAPTER [LIBRARIES ...])
#   NAME      as the command line knows it
#   HEADER    the adapter's header, absolute or from the top of this project
#   ADAPTER   the adapter's type, qualified
#   LIBRARIES what the header needs
#
# Call it before the folder oracles/ is added. Everything else follows: list, run, replay, nightly,
# fuzz targets and properties read the same list.

function(nearmiss_add_subject name header adapter)
  cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
  string(MAKE_C_IDENTIFIER ${name} identifier)
  set(source ${NEARMISS_GENERATED}/subjects/${identifier}.cpp)
  file(GENERATE OUTPUT ${source} CONTENT
"// Written by CMake: ${name}.
#include \"${header}\"
#include \"oracles/bind.hpp\"
namespace nearmiss {
Subject subject_${identifier}() { return bind<${adapter}>(\"${name}\"); }
}
")
  set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECTS ${identifier})
  set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECT_SOURCES ${source})
  set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECT_LIBRARIES ${arg_LIBRARIES})
endfunction()

# Writes the list of all subjects and makes the library that holds them.
function(nearmiss_finish_subjects)
  get_property(subjects GLOBAL PROPERTY NEARMISS_SUBJECTS)
  get_property(sources GLOBAL PROPERTY NEARMISS_SUBJECT_SOURCES)
  get_property(libraries GLOBAL PROPERTY NEARMISS_SUBJECT_LIBRARIES)
  set(text "// Written by CMake.\n#include \"impl/subject/subject.hpp\"\nnamespace nearmiss {\n")
  foreach(s IN LISTS subjects)
    string(APPEND text "Subject subject_${s}();\n")
  endforeach()
  string(APPEND text "const std::vector<Subject>& subjects() {\n  static const std::vector<Subject> all = {\n")
  foreach(s IN LISTS subjects)
    string(APPEND text "      subject_${s}(),\n")
  endforeach()
  string(APPEND text "  };\n  return all;\n}\n}\n")
  file(GENERATE OUTPUT ${NEARMISS_GENERATED}/subjects/all.cpp CONTENT "${text}")
  add_library(nearmiss_subjects STATIC ${sources} ${NEARMISS_GENERATED}/subjects/all.cpp
    ${PROJECT_SOURCE_DIR}/impl/subject/subject.cpp ${PROJECT_SOURCE_DIR}/impl/subject/worker.cpp)
  target_link_libraries(nearmiss_subjects PUBLIC nearmiss_flags collide PRIVATE ${libraries})
  target_include_directories(nearmiss_subjects PUBLIC ${NEARMISS_GENERATED})
endfunction()
