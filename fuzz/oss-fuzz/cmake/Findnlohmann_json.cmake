# nlohmann's JSON library is a header; its CMake package need not be installed.
find_path(NEARMISS_JSON_INCLUDE nlohmann/json.hpp REQUIRED)
set(nlohmann_json_FOUND ON)
if(NOT TARGET nlohmann_json::nlohmann_json)
  add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED GLOBAL)
  target_include_directories(nlohmann_json::nlohmann_json SYSTEM INTERFACE ${NEARMISS_JSON_INCLUDE})
endif()
