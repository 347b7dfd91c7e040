# Two subjects. The library of one requires compiler flags that no other source may get.
add_library(fast_library INTERFACE)
target_compile_options(fast_library INTERFACE -ffast-math)
target_compile_definitions(fast_library INTERFACE ONLY_FOR_THE_FAST_ONE)
nearmiss_add_subject(fast-one impl/adapters/collide.hpp nearmiss::adapters::CollideFastDouble LIBRARIES fast_library)
nearmiss_add_subject(other-one impl/adapters/collide.hpp nearmiss::adapters::CollideFastDouble)
