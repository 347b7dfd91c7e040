#include "reports/page/trade_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/files/errors.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/html.hpp"
#include "reports/findings/encoded.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

#ifdef NEARMISS_D3_FILE
constexpr const char* d3_of_trades = NEARMISS_D3_FILE;
#else
constexpr const char* d3_of_trades = nullptr;
#endif

/// Later files use earlier ones.
constexpr const char* trade_scripts[] = {"numbers.js",       "theme.js",        "trade_data.js", "trade_panels.js",
                                         "trade_profile.js", "trade_stages.js", "trade_view.js", "trade_main.js"};

std::string file_of_trade_page(const std::string& name) { return read_file(source_folder() + "/reports/page/" + name); }

std::string scripts_of_trade_page() {
  std::string text;
  for (const char* file : trade_scripts) text += file_of_trade_page(file) + "\n";
  return text;
}

/// Null for a file that is no trade.
nlohmann::ordered_json trade_in(const fs::path& file) {
  nlohmann::ordered_json trade = nlohmann::ordered_json::parse(read_file(file), nullptr, /*allow_exceptions=*/false);
  const auto has = [&](const char* member, Json::value_t type) {
    return trade.contains(member) && trade[member].type() == type;
  };
  const bool is_trade = trade.is_object() && has("schema", Json::value_t::number_unsigned) && trade["schema"] == 1 &&
                        has("profile", Json::value_t::object) && has("queries", Json::value_t::array) &&
                        has("tolerance", Json::value_t::object);
  return is_trade ? trade : nullptr;
}

/// The scene of a trade, with its folder where another trade of the page has the same name.
std::string tab_name(const nlohmann::ordered_json& trade, const fs::path& file, const nlohmann::ordered_json& others) {
  std::string name;
  if (trade.contains("scene") && trade["scene"].is_string()) name = trade["scene"];
  if (name.empty()) name = "generated cases";
  const bool is_taken = std::any_of(others.begin(), others.end(), [&](const auto& o) { return o["name"] == name; });
  return is_taken ? fmt::format("{} ({})", name, file.parent_path().filename().string()) : name;
}

}  // namespace

bool can_write_trade_pages() { return d3_of_trades != nullptr; }

std::string trade_page_with(const nlohmann::ordered_json& trade) {
  if (!can_write_trade_pages())
    throw BadInput("this build writes no pages, because node-d3 5 was not found when it was configured");
  std::string page = file_of_trade_page("trade.html");
  put_in_page(page, "/*STYLE*/", file_of_trade_page("page.css") + file_of_trade_page("trade.css"));
  put_in_page(page, "/*D3*/", in_html_script(read_file(d3_of_trades)));
  put_in_page(page, "/*SCRIPTS*/", in_html_script(scripts_of_trade_page()));
  put_in_page(page, "/*DATA*/",
              in_html_script(trade.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
  return page;
}

std::vector<fs::path> trades_in(const fs::path& folder) {
  std::vector<fs::path> folders{folder, folder / "trade"}, below;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.is_directory(none) && entry.path().filename() != "trade") below.push_back(entry.path());
  }
  std::sort(below.begin(), below.end());
  folders.insert(folders.end(), below.begin(), below.end());
  std::vector<fs::path> files;
  for (const fs::path& f : folders) {
    if (fs::is_regular_file(f / "trade.json", none)) files.push_back(f / "trade.json");
  }
  return files;
}

nlohmann::ordered_json trades_for_page(const fs::path& folder, std::size_t byte_limit,
                                       nlohmann::ordered_json& skipped) {
  nlohmann::ordered_json trades = nlohmann::ordered_json::array();
  std::size_t bytes = 0;
  for (const fs::path& file : trades_in(folder)) {
    const nlohmann::ordered_json trade = trade_in(file);
    const std::size_t size = trade.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).size();
    const char* why = trade.is_null()             ? "it is not a trade of schema 1"
                      : bytes + size > byte_limit ? "the page has no room for this trade; its folder can have its own"
                                                  : nullptr;
    if (why != nullptr) {
      skipped.push_back({{"file", file.string()}, {"why", why}});
      continue;
    }
    bytes += size;
    trades.push_back({{"name", tab_name(trade, file, trades)}, {"trade", trade}});
  }
  return trades;
}

void write_trade_page(const fs::path& trade_file, const fs::path& page) {
  const nlohmann::ordered_json trade = trade_in(trade_file);
  if (trade.is_null()) throw BadInput(fmt::format("{}: it is not a trade of schema 1", trade_file.string()));
  write_file(page, trade_page_with(trade));
}

}  // namespace nearmiss
