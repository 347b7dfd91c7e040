#include "reports/page/trade_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/codec.hpp"
#include "corpus/errors.hpp"
#include "corpus/source_folder.hpp"
#include "reports/engine/html.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

#ifdef NEARMISS_D3_FILE
constexpr const char* d3_of_trades = NEARMISS_D3_FILE;
#else
constexpr const char* d3_of_trades = nullptr;
#endif

/// Later files use earlier ones.
constexpr const char* trade_scripts[] = {"trade_data.js", "numbers.js", "trade_panels.js", "trade_profile.js",
                                         "trade_main.js"};

std::string file_of_trade_page(const std::string& name) { return read_file(source_folder() + "/reports/page/" + name); }

std::string scripts_of_trade_page() {
  std::string text;
  for (const char* file : trade_scripts) text += file_of_trade_page(file) + "\n";
  return text;
}

}  // namespace

bool can_write_trade_pages() { return d3_of_trades != nullptr; }

std::string trade_page_with(const nlohmann::ordered_json& trade) {
  if (!can_write_trade_pages())
    throw BadInput("this build writes no pages, because node-d3 5 was not found when it was configured");
  std::string page = file_of_trade_page("trade.html");
  put_in_page(page, "/*STYLE*/", file_of_trade_page("page.css") + file_of_trade_page("trade.css"));
  put_in_page(page, "/*D3*/", for_a_script(read_file(d3_of_trades)));
  put_in_page(page, "/*SCRIPTS*/", for_a_script(scripts_of_trade_page()));
  put_in_page(page, "/*DATA*/",
              for_a_script(trade.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
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

void write_trade_page(const fs::path& trade_file, const fs::path& page) {
  const nlohmann::ordered_json trade =
      nlohmann::ordered_json::parse(read_file(trade_file), nullptr, /*allow_exceptions=*/false);
  const bool is_trade = trade.is_object() && trade.value("schema", 0) == 1 && trade.contains("profile") &&
                        trade.contains("queries") && trade.contains("tolerance");
  if (!is_trade) throw BadInput(fmt::format("{}: it is not a trade of schema 1", trade_file.string()));
  write_file(page, trade_page_with(trade));
}

}  // namespace nearmiss
