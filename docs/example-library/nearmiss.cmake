# What Nearmiss must know of Skim: how it is built, and that skim::Adapter in adapter.hpp asks it.
add_library(skim STATIC ${CMAKE_CURRENT_LIST_DIR}/skim.c)
target_include_directories(skim PUBLIC ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(skim PUBLIC m)
nearmiss_add_subject(skim adapter.hpp skim::Adapter LIBRARIES skim)
