/// The page of a triage or of a run: one HTML file that needs no network.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// Throws BadInput where this build lacks a library of the page.
void check_page_can_be_written();

/// The page with its data (PageData::to_json), its styles and its scripts. Throws BadInput as above.
std::string page_with(const nlohmann::ordered_json& data);

/// The largest data of a page, so that with its libraries it stays below 20 MB.
inline constexpr std::size_t most_page_data = 18'000'000;

}  // namespace nearmiss
