#include "oracles/scene_limits.hpp"

#include <utility>

#include "impl/subject/foreign_promises.hpp"

namespace nearmiss {

namespace {
std::shared_ptr<const SceneLimits> the_limits;
}

void use_measure(SceneMeasure m) {
  set_measure(m.measure);
  count_promises_of_others(m.scene == nullptr);
  declare_as_reported(std::move(m.declared));
  the_limits = std::move(m.scene);
}

const SceneLimits* scene_limits() { return the_limits.get(); }

}  // namespace nearmiss
