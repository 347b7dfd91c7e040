# fmt as headers alone: its compiled library may be built for another C++ library than the fuzz targets.
find_path(NEARMISS_FMT_INCLUDE fmt/format-inl.h REQUIRED)
set(fmt_FOUND ON)
if(NOT TARGET fmt::fmt)
  add_library(fmt::fmt INTERFACE IMPORTED GLOBAL)
  target_include_directories(fmt::fmt SYSTEM INTERFACE ${NEARMISS_FMT_INCLUDE})
  target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
endif()
