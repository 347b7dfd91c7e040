# Defines the target collide::mpfr: MPFR with GMP, which the library collide::certified needs. If one of them is missing, the
# target is not defined and collide_certified_MISSING gives the reason.

set(collide_certified_MISSING "")
if(TARGET collide::mpfr)
  return()
endif()

foreach(library gmp mpfr)
  find_path(COLLIDE_${library}_INCLUDE_DIR ${library}.h)
  find_library(COLLIDE_${library}_LIBRARY ${library})
  mark_as_advanced(COLLIDE_${library}_INCLUDE_DIR COLLIDE_${library}_LIBRARY)
  if(NOT COLLIDE_${library}_INCLUDE_DIR OR NOT COLLIDE_${library}_LIBRARY)
    string(APPEND collide_certified_MISSING "${library} was not found (lib${library}-dev on Debian); ")
  endif()
endforeach()
string(REGEX REPLACE "; $" "" collide_certified_MISSING "${collide_certified_MISSING}")

if(collide_certified_MISSING STREQUAL "")
  get_target_property(imported collide::collide IMPORTED)
  if(imported)  # by find_package: visible in the same scope as collide::collide
    add_library(collide::mpfr INTERFACE IMPORTED)
  else()
    add_library(collide::mpfr INTERFACE IMPORTED GLOBAL)
  endif()
  target_include_directories(collide::mpfr SYSTEM INTERFACE ${COLLIDE_gmp_INCLUDE_DIR} ${COLLIDE_mpfr_INCLUDE_DIR})
  target_link_libraries(collide::mpfr INTERFACE ${COLLIDE_mpfr_LIBRARY} ${COLLIDE_gmp_LIBRARY})
endif()
