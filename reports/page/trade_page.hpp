/// The page of a trade: the price curves, the performance profile and a table. One HTML file that needs no network.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace nearmiss {

/// Whether this build has the drawing library of the page.
bool can_write_trade_pages();
/// The page with its data (reports/trade.schema.json), its styles and its scripts. Throws BadInput where this build
/// lacks the drawing library.
std::string trade_page_with(const nlohmann::ordered_json& trade);

/// The files trade.json of the folder itself, of its subfolder `trade`, and of its other subfolders, in this order.
std::vector<std::filesystem::path> trades_in(const std::filesystem::path& folder);
/// The trades of the folder for its page ("trades" of reports/page.schema.json), at most so many bytes. A file that is
/// no trade, or for which there is no room, is added to `skipped`.
nlohmann::ordered_json trades_for_page(const std::filesystem::path& folder, std::size_t byte_limit,
                                       nlohmann::ordered_json& skipped);
/// Writes the page of the file trade.json. Throws BadInput for a file that is no trade.
void write_trade_page(const std::filesystem::path& trade_file, const std::filesystem::path& page);
/// Its usual place: trade.html beside it.
inline std::filesystem::path usual_trade_page(const std::filesystem::path& trade_file) {
  return trade_file.parent_path() / "trade.html";
}

}  // namespace nearmiss
