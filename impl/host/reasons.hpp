/// Reasons of breakages that code on the judge's side must know again.
#pragma once

#include <string_view>

namespace nearmiss {

/// The reason of a breakage at the memory limit, as answer_or_broke() gives it too.
inline constexpr std::string_view memory_limit_reason = "memory limit reached";
/// The end of the reason where the host broke in a request of many cases, and none of them did when it was asked alone.
inline constexpr std::string_view not_again_suffix = "; in a batch, not again alone";

}  // namespace nearmiss
