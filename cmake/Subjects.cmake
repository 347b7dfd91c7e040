# nearmiss_add_subject(NAME HEADER ADAPTER [ISOLATED] [LIBRARIES ...])
#   NAME      as the command line knows it
#   HEADER    the adapter's header: beside the file that calls this, or from the top of this project
#   ADAPTER   the adapter's type, qualified
#   LIBRARIES what the header needs. Their compile options and definitions are for this adapter alone
#   ISOLATED  loaded at run time with shared libraries of its own, apart from all others: for a library whose names another
#             subject's library has as well, such as another version of it. Not in builds with sanitizers or libFuzzer
#
# Your own library is added by a CMake file of yours, which calls this and is named to CMake by
# -DNEARMISS_ADD=FILE; docs/bring-your-own.md shows it. Everything else follows: list, run, replay, nightly, fuzz
# targets and properties read the same list.

function(nearmiss_add_subject name header adapter)
  cmake_parse_arguments(arg "ISOLATED" "" "LIBRARIES" ${ARGN})
  string(MAKE_C_IDENTIFIER ${name} identifier)
  get_property(known GLOBAL PROPERTY NEARMISS_SUBJECTS)
  if(identifier IN_LIST known)
    message(FATAL_ERROR "nearmiss_add_subject: there is a subject \"${name}\" already")
  endif()
  if(EXISTS ${CMAKE_CURRENT_LIST_DIR}/${header})
    set(header ${CMAKE_CURRENT_LIST_DIR}/${header})
  elseif(NOT EXISTS ${header} AND NOT EXISTS ${PROJECT_SOURCE_DIR}/${header})
    message(FATAL_ERROR "nearmiss_add_subject: ${name}: there is no header ${header}, neither in ${CMAKE_CURRENT_LIST_DIR} nor in ${PROJECT_SOURCE_DIR}")
  endif()
  if(arg_ISOLATED AND (NEARMISS_SANITIZE OR NEARMISS_LIBFUZZER))
    message(STATUS "The subject ${name} is left out: what is loaded apart has no access to the runtime of sanitizers")
    return()
  endif()
  set(definition "Subject subject_${identifier}() { return bind<${adapter}>(\"${name}\"); }")
  set(includes "#include \"oracles/bind.hpp\"")
  if(arg_ISOLATED)
    string(APPEND includes "\n#include \"impl/subject/contained.hpp\"")
    set(definition "extern \"C\" const Subject* nearmiss_isolated_subject() {
  static const Subject subject = bind<Contained<${adapter}>>(\"${name}\");
  return &subject;
}")
  endif()
  set(source ${NEARMISS_GENERATED}/subjects/${identifier}.cpp)
  file(GENERATE OUTPUT ${source} CONTENT
"// Written by CMake: ${name}.
#include \"${header}\"
${includes}
namespace nearmiss {
${definition}
}
")
  set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECTS ${identifier})
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_LIBRARIES ${arg_LIBRARIES})
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_ISOLATED ${arg_ISOLATED})
  if(NEARMISS_READS_ADDED)
    set_property(GLOBAL APPEND PROPERTY NEARMISS_ADDED_SUBJECTS ${name})
  endif()
endfunction()

# Writes the source `file` that lists subjects. A program that compiles one of its own links no other subject.
function(nearmiss_write_subjects file)  # SUBJECT ...
  set(subjects ${ARGN})
  set(text "// Written by CMake.\n#include \"impl/subject/added.hpp\"\n#include \"impl/subject/subject.hpp\"\nnamespace nearmiss {\n")
  foreach(s IN LISTS subjects)
    string(APPEND text "Subject subject_${s}();\n")
  endforeach()
  string(APPEND text "std::vector<Subject> built_in_subjects() {\n  return {\n")
  foreach(s IN LISTS subjects)
    string(APPEND text "      subject_${s}(),\n")
  endforeach()
  get_property(added GLOBAL PROPERTY NEARMISS_ADDED_SUBJECTS)
  list(TRANSFORM added REPLACE "(.+)" "\"\\1\"")
  list(JOIN added ", " added)
  string(APPEND text "  };\n}\nstd::vector<std::string> added_subjects() { return {${added}}; }\n}\n")
  file(GENERATE OUTPUT ${file} CONTENT "${text}")
endfunction()

# Compiles a subject's adapter by itself, so that nobody else sees what its libraries ask of a compiler, and adds it to
# nearmiss_subjects.
function(nearmiss_compile_subject identifier)
  get_property(libraries GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_LIBRARIES)
  get_property(isolated GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_ISOLATED)
  set(target nearmiss_subject_${identifier})
  set(source ${NEARMISS_GENERATED}/subjects/${identifier}.cpp)
  if(isolated)
    add_library(${target} MODULE ${source})
    set(loader ${NEARMISS_GENERATED}/subjects/${identifier}_loader.cpp)
    file(GENERATE OUTPUT ${loader} CONTENT
"// Written by CMake.
#include \"impl/subject/isolated.hpp\"
namespace nearmiss {
Subject subject_${identifier}() { return isolated_subject(\"$<TARGET_FILE:${target}>\"); }
}
")
    target_sources(nearmiss_subjects PRIVATE ${loader})
    add_dependencies(nearmiss_subjects ${target})
  else()
    add_library(${target} OBJECT ${source})
    target_sources(nearmiss_subjects PRIVATE $<TARGET_OBJECTS:${target}>)
    foreach(library IN LISTS libraries)
      target_link_libraries(nearmiss_subjects INTERFACE $<LINK_ONLY:${library}>)
    endforeach()
  endif()
  target_link_libraries(${target} PRIVATE nearmiss_flags collide ${libraries})
  target_include_directories(${target} PRIVATE ${NEARMISS_GENERATED})
endfunction()

# Writes the list of all subjects and makes the library that holds them.
function(nearmiss_finish_subjects)
  get_property(subjects GLOBAL PROPERTY NEARMISS_SUBJECTS)
  nearmiss_write_subjects(${NEARMISS_GENERATED}/subjects/all.cpp ${subjects})
  add_library(nearmiss_subjects STATIC ${NEARMISS_GENERATED}/subjects/all.cpp
    ${PROJECT_SOURCE_DIR}/impl/subject/isolated.cpp ${PROJECT_SOURCE_DIR}/impl/subject/subject.cpp
    ${PROJECT_SOURCE_DIR}/impl/subject/worker.cpp)
  target_link_libraries(nearmiss_subjects PUBLIC nearmiss_flags collide PRIVATE ${CMAKE_DL_LIBS})
  target_include_directories(nearmiss_subjects PUBLIC ${NEARMISS_GENERATED})
  foreach(s IN LISTS subjects)
    nearmiss_compile_subject(${s})
  endforeach()
endfunction()

# Reads the files of NEARMISS_ADD; each adds subjects.
function(nearmiss_read_added)
  set(NEARMISS_READS_ADDED ON)
  foreach(file IN LISTS NEARMISS_ADD)
    get_filename_component(file ${file} ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
    if(NOT EXISTS ${file} OR IS_DIRECTORY ${file})
      message(FATAL_ERROR "NEARMISS_ADD names ${file}, and there is no such file")
    endif()
    include(${file})
  endforeach()
endfunction()
