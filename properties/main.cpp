/// Runs the properties. RapidCheck draws the same values on every run unless RC_PARAMS changes that. RapidCheck's
/// shrinking is off, because a stream's number cannot shrink; cases have their own shrinker.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "impl/host/hosts.hpp"
#include "oracles/exact/number_memory.hpp"

int main(int argc, char** argv) try {
  constexpr int keep_what_is_set = 0;
  ::setenv("RC_PARAMS", "seed=1 max_success=200 noshrink=1", keep_what_is_set);
  nearmiss::use_pool_for_numbers();
  nearmiss::load_subjects_of_environment();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
} catch (const nearmiss::BadSubject& e) {
  std::fprintf(stderr, "nearmiss_properties: %s\n", e.what());
  return 2;
}
