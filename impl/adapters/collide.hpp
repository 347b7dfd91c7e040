/// The tiers Fast and Accurate of `collide` as subjects, with the functions of all queries.
#pragma once

#include "impl/adapters/collide_tiers.hpp"
#include "nearmiss/catalogue_inputs.hpp"   // written by CMake from impl/catalogue/catalogue.def
#include "nearmiss/collide_functions.hpp"  // likewise
