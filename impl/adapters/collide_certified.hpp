/// The certified tier of `collide` as subjects.
#pragma once

#include <collide/certified.hpp>

#include "impl/adapters/collide.hpp"

namespace nearmiss::adapters {

using CollideCertifiedFloat = Collide<collide::Certified, float>;
using CollideCertifiedDouble = Collide<collide::Certified, double>;

}  // namespace nearmiss::adapters
