/// All tiers of `collide` as subjects, without the functions of the queries (nearmiss/collide_functions/QUERY.hpp).
#pragma once

#include <collide/certified.hpp>
#include <collide/decisive.hpp>

#include "impl/adapters/collide_tiers.hpp"

namespace nearmiss::adapters {

using CollideDecisiveFloat = Collide<collide::Decisive, float>;
using CollideDecisiveDouble = Collide<collide::Decisive, double>;
using CollideCertifiedFloat = Collide<collide::Certified, float>;
using CollideCertifiedDouble = Collide<collide::Certified, double>;

}  // namespace nearmiss::adapters
