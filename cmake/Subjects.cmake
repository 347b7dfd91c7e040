# nearmiss_add_subject(NAME HEADER ADAPTER [OWN] [REFEREE] [ISOLATED] [WITH SUBJECT] [PER_QUERY FOLDER] [STAGES HEADER FUNCTION] [LIBRARIES ...])
#   NAME      its name on the command line
#   HEADER    the adapter's header: relative to the calling file, or to the top of this project
#   ADAPTER   the qualified name of the adapter's type
#   LIBRARIES the libraries that the header needs. Their compile options and definitions apply only to this adapter
#   OWN       a subject of this project: fuzz targets and property tests check its contracts, and relations require the
#             same bits of it
#   REFEREE   gives second opinions on the findings of other subjects; a referee never decides
#   STAGES    the header and the qualified name of a StageTallyFunction (impl/subject/stages.hpp), for a subject that answers
#             in stages: 'nearmiss trade' shows what each stage costs
#   ISOLATED  never linked into a program with other subjects: for a library that defines the same symbols as another
#             subject's library, such as another version of it. Fuzz targets and property tests, which ask subjects in
#             their own process, do not include it
#   WITH      another subject of the same header and libraries, added before: one source holds both, and the compiler reads
#             the header once
#   PER_QUERY a folder on the include path, with a header QUERY.hpp for each query. HEADER and QUERY.hpp together answer
#             the query. The queries are then compiled in several sources, so that a change of one query compiles one of
#             them again
#
# To add your own library, write a CMake file that calls this function, and pass it to CMake by -DNEARMISS_ADD=FILE
# (docs/bring-your-own.md). The commands list, run, replay and nightly, the fuzz targets and the properties then include
# it.

function(nearmiss_add_subject name header adapter)
  cmake_parse_arguments(arg "OWN;REFEREE;ISOLATED" "WITH;PER_QUERY" "STAGES;LIBRARIES" ${ARGN})
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
  set(source ${identifier})  # the subject whose source holds this one
  if(arg_WITH)
    string(MAKE_C_IDENTIFIER ${arg_WITH} other)
    get_property(source GLOBAL PROPERTY NEARMISS_SUBJECT_${other}_SOURCE)
    if(NOT source)
      message(FATAL_ERROR "nearmiss_add_subject: ${name}: WITH names \"${arg_WITH}\", and no such subject was added before")
    endif()
    set(arg_HEADER ${header})
    foreach(property HEADER LIBRARIES ISOLATED PER_QUERY)
      get_property(of_other GLOBAL PROPERTY NEARMISS_SUBJECT_${source}_${property})
      if(NOT "${of_other}" STREQUAL "${arg_${property}}")
        message(FATAL_ERROR "nearmiss_add_subject: ${name}: its ${property} is not that of ${arg_WITH}")
      endif()
    endforeach()
  endif()
  set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECTS ${identifier})
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_NAME ${name})
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_HEADER ${header})
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_LIBRARIES "${arg_LIBRARIES}")
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_ISOLATED ${arg_ISOLATED})
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_PER_QUERY "${arg_PER_QUERY}")
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_SOURCE ${source})
  set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECT_${source}_ADAPTERS ${adapter})
  set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECT_${source}_MEMBERS ${identifier})
  if(arg_PER_QUERY AND NOT arg_ISOLATED)
    set_property(GLOBAL APPEND PROPERTY NEARMISS_SUBJECTS_PER_QUERY ${identifier})
  endif()
  set_property(GLOBAL APPEND_STRING PROPERTY NEARMISS_SUBJECT_${source}_FUNCTIONS
    "Subject subject_${identifier}() { return bind<${adapter}>(\"${name}\"); }\n")
  set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_STAGES "${arg_STAGES}")
  if(arg_OWN)
    set_property(GLOBAL APPEND PROPERTY NEARMISS_OWN_SUBJECTS ${name})
  endif()
  if(arg_REFEREE)
    set_property(GLOBAL APPEND PROPERTY NEARMISS_REFEREES ${name})
  endif()
  if(NEARMISS_READS_ADDED)
    set_property(GLOBAL APPEND PROPERTY NEARMISS_ADDED_SUBJECTS ${name})
  endif()
  if(NEARMISS_EXAMINER AND NOT arg_OWN AND NOT NEARMISS_READS_ADDED)
    set_property(GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_FOREIGN ON)  # its adapter is compiled in the other build
  endif()
endfunction()

# Sets `variable` to the C++ function `function` that returns names.
function(nearmiss_names_function function variable)  # NAME ...
  list(TRANSFORM ARGN REPLACE "(.+)" "\"\\1\"")
  list(JOIN ARGN ", " names)
  set(${variable} "std::vector<std::string> ${function}() { return {${names}}; }\n" PARENT_SCOPE)
endfunction()

# Sets `variable` to those C++ functions of impl/subject/provenance.hpp that do not depend on how subjects are started.
function(nearmiss_provenance variable)  # SUBJECT ...
  set(names "")
  foreach(s IN LISTS ARGN)
    get_property(name GLOBAL PROPERTY NEARMISS_SUBJECT_${s}_NAME)
    list(APPEND names ${name})
  endforeach()
  nearmiss_names_function(built_in_subjects text ${names})
  foreach(kind "own_subjects OWN_SUBJECTS" "added_subjects ADDED_SUBJECTS" "names_of_referees REFEREES")
    separate_arguments(kind)
    list(GET kind 0 function)
    list(GET kind 1 property)
    get_property(names GLOBAL PROPERTY NEARMISS_${property})
    nearmiss_names_function(${function} one ${names})
    string(APPEND text "${one}")
  endforeach()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# Writes the source `file` with own_subjects_in_process().
function(nearmiss_write_own_subjects file)
  get_property(names GLOBAL PROPERTY NEARMISS_OWN_SUBJECTS)
  set(declared "")
  set(calls "")
  foreach(name IN LISTS names)
    string(MAKE_C_IDENTIFIER ${name} identifier)
    get_property(isolated GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_ISOLATED)
    if(NOT isolated)
      string(APPEND declared "Subject subject_${identifier}();\n")
      string(APPEND calls "subject_${identifier}(), ")
    endif()
  endforeach()
  file(GENERATE OUTPUT ${file} CONTENT
"// Written by CMake.
#include \"impl/subject/provenance.hpp\"
namespace nearmiss {
${declared}std::vector<Subject> own_subjects_in_process() {
  std::vector<Subject> all{${calls}};
  for (Subject& s : all) s.own = true;
  return all;
}
}
")
endfunction()

# Writes the source `file` that lists subjects whose functions are linked into the program.
function(nearmiss_write_subjects file)  # SUBJECT ...
  set(declared "")
  set(calls "")
  foreach(s IN LISTS ARGN)
    get_property(name GLOBAL PROPERTY NEARMISS_SUBJECT_${s}_NAME)
    string(APPEND declared "Subject subject_${s}();\n")
    string(APPEND calls "    if (name == \"${name}\") all.push_back(subject_${s}());\n")
  endforeach()
  nearmiss_provenance(provenance ${ARGN})
  file(GENERATE OUTPUT ${file} CONTENT
"// Written by CMake.
#include \"impl/subject/provenance.hpp\"
namespace nearmiss {
${declared}std::vector<Subject> start_built_in(const std::vector<std::string>& names) {
  std::vector<Subject> all;
  for (const std::string& name : names) {
${calls}  }
  return all;
}
std::vector<Subject> start_at_hand(const std::vector<std::string>& names) { return start_built_in(names); }
${provenance}}
")
endfunction()

# Writes the source `file` that lists subjects with the programs that are their hosts.
function(nearmiss_write_hosts file)  # SUBJECT ...
  set(hosts "")
  foreach(s IN LISTS ARGN)
    get_property(name GLOBAL PROPERTY NEARMISS_SUBJECT_${s}_NAME)
    string(APPEND hosts "    if (name == \"${name}\") all.push_back({name, \"$<TARGET_FILE:nearmiss_host_${s}>\"});\n")
  endforeach()
  nearmiss_provenance(provenance ${ARGN})
  file(GENERATE OUTPUT ${file} CONTENT
"// Written by CMake.
#include \"impl/host/hosts.hpp\"
#include \"impl/subject/provenance.hpp\"
namespace nearmiss {
namespace {
std::vector<HostOfBuild> hosts_of(const std::vector<std::string>& names) {
  std::vector<HostOfBuild> all;
  for (const std::string& name : names) {
${hosts}  }
  return all;
}
}
std::vector<Subject> start_built_in(const std::vector<std::string>& names) { return built_and_hosted(hosts_of(names)); }
std::vector<Subject> start_at_hand(const std::vector<std::string>& names) { return hosted_at_hand(hosts_of(names)); }
${provenance}}
")
endfunction()

# Writes the sources of a subject that is compiled PER_QUERY, apart from its main source: each holds the functions of a
# share of the queries. Which one holds a query follows from the query's name alone (see nearmiss_unite). Sets `declared`
# to the text by which the main source says that these functions are elsewhere, and `files` to the sources. For fuzz
# targets, a share also has a function subject_NAME_of_QUERY() for each subject and query: the subject with that query alone.
function(nearmiss_write_shares identifier header folder declared files)
  set(shares 12)
  get_property(adapters GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_ADAPTERS)
  get_property(members GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_MEMBERS)
  set(elsewhere "")
  foreach(adapter IN LISTS adapters)
    string(APPEND elsewhere "#define NEARMISS_QUERY(query) extern template Offering offering_of<${adapter}, inputs::query<${adapter}::Number>>(std::string_view);\n#include \"impl/catalogue/catalogue.def\"\n#undef NEARMISS_QUERY\n")
  endforeach()
  foreach(query IN LISTS NEARMISS_QUERIES)
    nearmiss_share_of(${query} ${shares} share)
    list(APPEND used ${share})
    string(APPEND includes_${share} "#include \"${folder}/${query}.hpp\"\n")
    foreach(adapter member IN ZIP_LISTS adapters members)
      string(APPEND functions_${share} "template Offering offering_of<${adapter}, inputs::${query}<${adapter}::Number>>(std::string_view);\n")
      if(NEARMISS_LIBFUZZER)
        get_property(name GLOBAL PROPERTY NEARMISS_SUBJECT_${member}_NAME)
        string(APPEND functions_${share} "Subject subject_${member}_of_${query}() { return bind_one<${adapter}, inputs::${query}<${adapter}::Number>>(\"${name}\", \"${query}\"); }\n")
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES used)
  set(written "")
  foreach(share IN LISTS used)
    set(source ${NEARMISS_GENERATED}/subjects/${identifier}_${share}.cpp)
    file(GENERATE OUTPUT ${source} CONTENT
"// Written by CMake: a share of the queries.
#include \"${header}\"
#include \"impl/subject/offering.hpp\"
${includes_${share}}namespace nearmiss {
${functions_${share}}}
")
    list(APPEND written ${source})
  endforeach()
  set(${declared} "${elsewhere}" PARENT_SCOPE)
  set(${files} "${written}" PARENT_SCOPE)
endfunction()

# Compiles the sources of a subject, and of the subjects WITH it, in a target of its own, so that the compile options of its
# libraries apply to no other source. Unless it is isolated, adds it to nearmiss_subjects for the programs that ask it in
# their own process.
function(nearmiss_compile_subject identifier)
  get_property(name GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_NAME)
  get_property(header GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_HEADER)
  get_property(libraries GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_LIBRARIES)
  get_property(isolated GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_ISOLATED)
  get_property(functions GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_FUNCTIONS)
  get_property(foreign GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_FOREIGN)
  if(foreign)
    if(NOT isolated)
      list(TRANSFORM libraries REPLACE "(.+)" "$<LINK_ONLY:\\1>")
      set_property(GLOBAL APPEND PROPERTY NEARMISS_FOREIGN_LIBRARIES ${libraries})
    endif()
    return()
  endif()
  set(target nearmiss_subject_${identifier})
  set(source ${NEARMISS_GENERATED}/subjects/${identifier}.cpp)
  get_property(per_query GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_PER_QUERY)
  set(elsewhere "")
  set(shares "")
  if(per_query)
    nearmiss_write_shares(${identifier} ${header} ${per_query} elsewhere shares)
  endif()
  file(GENERATE OUTPUT ${source} CONTENT
"// Written by CMake: ${name}.
#include \"${header}\"
#include \"impl/subject/bind.hpp\"
namespace nearmiss {
${elsewhere}${functions}}
")
  add_library(${target} OBJECT ${source} ${shares})
  target_link_libraries(${target} PRIVATE nearmiss_flags collide ${libraries})
  target_include_directories(${target} PRIVATE ${NEARMISS_GENERATED})
  if(NOT per_query)  # an adapter: its library is compiled elsewhere
    target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O0>)
  endif()
  if(NOT isolated AND per_query AND NEARMISS_LIBFUZZER AND NEARMISS_FUZZ_SHARED)
    # The shared library of the fuzz targets must not contain them: a target links what its query needs.
    add_library(${target}_per_query STATIC $<TARGET_OBJECTS:${target}>)
    target_link_libraries(${target}_per_query INTERFACE nearmiss_subjects ${libraries})
    target_link_libraries(nearmiss_per_query INTERFACE ${target}_per_query)
  elseif(NOT isolated)
    target_sources(nearmiss_subjects PRIVATE $<TARGET_OBJECTS:${target}>)
    foreach(library IN LISTS libraries)
      target_link_libraries(nearmiss_subjects INTERFACE $<LINK_ONLY:${library}>)
    endforeach()
  endif()
endfunction()

# Makes the program that is the host of a subject.
function(nearmiss_make_host identifier)
  get_property(name GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_NAME)
  get_property(libraries GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_LIBRARIES)
  get_property(source GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_SOURCE)
  get_property(stages GLOBAL PROPERTY NEARMISS_SUBJECT_${identifier}_STAGES)
  set(include "")
  set(tally "")
  if(stages)
    list(GET stages 0 header)
    list(GET stages 1 function)
    set(include "#include \"${header}\"\n")
    set(tally ", ${function}")
  endif()
  set(main ${NEARMISS_GENERATED}/hosts/${identifier}.cpp)
  file(GENERATE OUTPUT ${main} CONTENT
"// Written by CMake: the host of ${name}.
#include <unistd.h>
#include \"impl/host/built_in_host.hpp\"
${include}namespace nearmiss {
Subject subject_${identifier}();
}
int main() { _exit(nearmiss::run_built_in_host(nearmiss::subject_${identifier}${tally})); }
")
  add_executable(nearmiss_host_${identifier} ${main} $<TARGET_OBJECTS:nearmiss_subject_${source}>)
  target_link_libraries(nearmiss_host_${identifier} PRIVATE nearmiss_host)
  foreach(library IN LISTS libraries)
    target_link_libraries(nearmiss_host_${identifier} PRIVATE $<LINK_ONLY:${library}>)
  endforeach()
  set_target_properties(nearmiss_host_${identifier} PROPERTIES
    OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY ${NEARMISS_HOSTS})
endfunction()

# Makes the hosts of all subjects, and these libraries:
#   nearmiss_wall        the judge's side of the wall between processes. It needs a list of the subjects: one of these two
#   nearmiss_hosts       lists all subjects as programs
#   nearmiss_in_process  lists those that are not isolated as functions; with nearmiss_subjects
#   nearmiss_subjects    the functions of these subjects
function(nearmiss_finish_subjects)
  find_package(nlohmann_json REQUIRED)
  set(NEARMISS_HOSTS ${PROJECT_BINARY_DIR}/hosts)
  get_property(subjects GLOBAL PROPERTY NEARMISS_SUBJECTS)
  find_package(fmt REQUIRED)
  # The queries.
  if(NEARMISS_EXAMINER)
    nearmiss_import(nearmiss_catalogue libnearmiss_catalogue.a nearmiss_flags collide fmt::fmt)
    set_target_properties(nearmiss_catalogue PROPERTIES IMPORTED_NO_SYSTEM ON)
    target_include_directories(nearmiss_catalogue INTERFACE ${NEARMISS_GENERATED})
  else()
    set(catalogue ${PROJECT_SOURCE_DIR}/impl/catalogue)
    add_library(nearmiss_catalogue STATIC ${catalogue}/case.cpp ${catalogue}/catalogue.cpp ${catalogue}/counted_inputs.cpp
      ${catalogue}/operands.cpp ${catalogue}/shape.cpp)
    nearmiss_examines(nearmiss_catalogue)
    nearmiss_compile_for_a_short_wait(nearmiss_catalogue)
    target_link_libraries(nearmiss_catalogue PUBLIC nearmiss_flags collide PRIVATE fmt::fmt)
    target_include_directories(nearmiss_catalogue PUBLIC ${NEARMISS_GENERATED})
  endif()
  # The parts of a host other than its subject.
  add_library(nearmiss_host STATIC
    ${PROJECT_SOURCE_DIR}/impl/host/serve.cpp
    ${PROJECT_SOURCE_DIR}/impl/host/shared_layout.cpp
    ${PROJECT_SOURCE_DIR}/impl/host/timing.cpp
    ${PROJECT_SOURCE_DIR}/impl/subject/convention.cpp)
  nearmiss_examines(nearmiss_host)
  target_link_libraries(nearmiss_host PUBLIC nearmiss_flags collide PRIVATE nearmiss_catalogue nlohmann_json::nlohmann_json)
  target_include_directories(nearmiss_host PUBLIC ${NEARMISS_GENERATED})
  add_executable(nearmiss_host_of_plugins ${PROJECT_SOURCE_DIR}/impl/host/plugin_host.cpp)
  target_link_libraries(nearmiss_host_of_plugins PRIVATE nearmiss_host ${CMAKE_DL_LIBS})
  set_target_properties(nearmiss_host_of_plugins PROPERTIES OUTPUT_NAME plugin RUNTIME_OUTPUT_DIRECTORY ${NEARMISS_HOSTS})
  set(in_process "")
  foreach(s IN LISTS subjects)
    get_property(isolated GLOBAL PROPERTY NEARMISS_SUBJECT_${s}_ISOLATED)
    if(NOT isolated)
      list(APPEND in_process ${s})
    endif()
  endforeach()
  nearmiss_write_subjects(${NEARMISS_GENERATED}/subjects/all.cpp ${in_process})
  if(NOT NEARMISS_EXAMINER)
    nearmiss_write_hosts(${NEARMISS_GENERATED}/subjects/hosts.cpp ${subjects})
  endif()
  # The judge's side of the wall between processes.
  set(NEARMISS_JUDGE_SIDE
    subject/subject.cpp
    host/engines.cpp
    host/hosts.cpp
    host/exposure.cpp
    host/processes.cpp
    host/separation.cpp
    host/supervisor.cpp
    host/error_line.cpp
    host/replies.cpp
    host/worker.cpp
    subject/printable.cpp)
  list(TRANSFORM NEARMISS_JUDGE_SIDE PREPEND ${PROJECT_SOURCE_DIR}/impl/)
  set(NEARMISS_JUDGE_SIDE ${NEARMISS_JUDGE_SIDE} PARENT_SCOPE)
  add_library(nearmiss_wall STATIC ${NEARMISS_JUDGE_SIDE})
  nearmiss_examines(nearmiss_wall)
  nearmiss_compile_for_a_short_wait(nearmiss_wall)
  target_link_libraries(nearmiss_wall PUBLIC nearmiss_catalogue nearmiss_host PRIVATE fmt::fmt nlohmann_json::nlohmann_json)
  nearmiss_unite(nearmiss_wall 1)
  target_compile_definitions(nearmiss_wall PRIVATE NEARMISS_HOSTS="${NEARMISS_HOSTS}" NEARMISS_TOP="${PROJECT_SOURCE_DIR}")
  if(NEARMISS_SANITIZE)
    target_compile_definitions(nearmiss_wall PRIVATE NEARMISS_SANITIZED_HOSTS)
  endif()
  target_include_directories(nearmiss_wall PUBLIC ${NEARMISS_GENERATED})
  nearmiss_write_own_subjects(${NEARMISS_GENERATED}/subjects/own.cpp)
  add_library(nearmiss_subjects STATIC ${NEARMISS_GENERATED}/subjects/own.cpp)
  target_link_libraries(nearmiss_subjects PUBLIC nearmiss_wall)
  add_library(nearmiss_in_process OBJECT ${NEARMISS_GENERATED}/subjects/all.cpp)
  target_link_libraries(nearmiss_in_process PUBLIC nearmiss_subjects)
  if(NOT NEARMISS_EXAMINER)
    # The command line does not depend on the hosts: the launcher builds those that a command asks for.
    add_custom_target(hosts)
    add_custom_target(referees)
    add_library(nearmiss_hosts OBJECT ${NEARMISS_GENERATED}/subjects/hosts.cpp)
    target_link_libraries(nearmiss_hosts PUBLIC nearmiss_flags collide)
  endif()
  add_library(nearmiss_per_query INTERFACE)  # subjects PER_QUERY that are not in nearmiss_subjects
  foreach(s IN LISTS subjects)
    get_property(source GLOBAL PROPERTY NEARMISS_SUBJECT_${s}_SOURCE)
    if(source STREQUAL s)
      nearmiss_compile_subject(${s})
    endif()
    if(NOT NEARMISS_EXAMINER)
      nearmiss_make_host(${s})
      add_dependencies(hosts nearmiss_host_${s})
      get_property(name GLOBAL PROPERTY NEARMISS_SUBJECT_${s}_NAME)
      get_property(names GLOBAL PROPERTY NEARMISS_REFEREES)
      if(name IN_LIST names)
        add_dependencies(referees nearmiss_host_${s})
      endif()
    endif()
  endforeach()
  add_dependencies(nearmiss_wall nearmiss_host_of_plugins)
  set(NEARMISS_HOSTS ${NEARMISS_HOSTS} PARENT_SCOPE)
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
