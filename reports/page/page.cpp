#include "reports/page/page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "corpus/files/errors.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/html.hpp"
#include "reports/findings/encoded.hpp"

namespace nearmiss {

namespace {

#ifdef NEARMISS_D3_FILE
constexpr const char* d3_file = NEARMISS_D3_FILE;
#else
constexpr const char* d3_file = nullptr;
#endif
#ifdef NEARMISS_THREE_FOLDER
constexpr const char* three_folder = NEARMISS_THREE_FOLDER;
#else
constexpr const char* three_folder = nullptr;
#endif

/// Later files use earlier ones.
constexpr const char* page_scripts[] = {
    "numbers.js",      "theme.js",      "data.js",     "shapes.js",     "picture.js",      "plot.js",
    "trend.js",        "table.js",      "finding.js",  "trade_data.js", "trade_panels.js", "trade_profile.js",
    "trade_stages.js", "trade_view.js", "subjects.js", "views.js",      "main.js"};

std::string page_file(const std::string& name) { return read_file(source_folder() + "/reports/page/" + name); }

std::string three_text() {
  std::string text;
  for (const char* file :
       {"build/three.min.js", "examples/js/controls/OrbitControls.js", "examples/js/lines/LineSegmentsGeometry.js",
        "examples/js/lines/LineMaterial.js", "examples/js/lines/LineSegments2.js"}) {
    text += read_file(fmt::format("{}/{}", three_folder, file)) + "\n";
  }
  return text;
}

std::string scripts_text() {
  std::string text;
  for (const char* file : page_scripts) text += page_file(file) + "\n";
  return text;
}

}  // namespace

void check_page_can_be_written() {
  const std::string d3 = d3_file == nullptr ? "node-d3 5" : "",
                    three = three_folder == nullptr ? "libjs-three 111" : "";
  if (d3.empty() && three.empty()) return;
  throw BadInput(fmt::format("this build writes no pages, because {} was not found when it was configured",
                             d3.empty() || three.empty() ? d3 + three : d3 + " and " + three));
}

std::string page_with(const nlohmann::ordered_json& data) {
  check_page_can_be_written();
  std::string page = page_file("page.html");
  put_in_page(page, "/*STYLE*/", page_file("page.css") + page_file("trade.css"));
  put_in_page(page, "/*D3*/", in_html_script(read_file(d3_file)));
  put_in_page(page, "/*THREE*/", in_html_script(three_text()));
  put_in_page(page, "/*SCRIPTS*/", in_html_script(scripts_text()));
  put_in_page(page, "/*DATA*/",
              in_html_script(data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
  return page;
}

}  // namespace nearmiss
