/// Runs the properties. RapidCheck's draws are the same on every run unless RC_PARAMS says otherwise;
/// its shrinking is off, because a stream's number has nothing to shrink: cases have a shrinker of their own.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "impl/host/hosts.hpp"

int main(int argc, char** argv) try {
  constexpr int keep_what_is_set = 0;
  ::setenv("RC_PARAMS", "seed=1 max_success=200 noshrink=1", keep_what_is_set);
  nearmiss::load_subjects_of_environment();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
} catch (const nearmiss::BadSubject& e) {
  std::fprintf(stderr, "nearmiss_properties: %s\n", e.what());
  return 2;
}
