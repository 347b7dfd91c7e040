/// Parts of a trade as JSON, for all files that have them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "reports/trade/summary.hpp"

namespace nearmiss {

/// null without a number, and for one that is not finite.
nlohmann::ordered_json optional_to_json(const std::optional<double>& x);
nlohmann::ordered_json rate_to_json(const Rate& r);
nlohmann::ordered_json requirement_to_json(const MetRequirement& r);
nlohmann::ordered_json tolerance_to_json(const TradeTolerance& t);

}  // namespace nearmiss
