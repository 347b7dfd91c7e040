#include <fmt/format.h>

#include "reports/findings/encoded.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace plugin_text {
namespace {

constexpr std::string_view helper = R"(/* The function of the plugin that answers the query; NULL where it has none. */
static nearmiss_answer_function function_for(const char* query) {
  const nearmiss_plugin* plugin = nearmiss_plugin_entry();
  for (size_t i = 0; i < plugin->offer_count; ++i) {
    if (strcmp(plugin->offers[i].query, query) == 0) return plugin->offers[i].answer;
  }
  return NULL;
}

/* The functions of a plugin of version 2 have no count. */
static int answer_by(nearmiss_answer_function function, const double* inputs, size_t count, nearmiss_answer* answer) {
  typedef int (*without_count)(const double* inputs, nearmiss_answer* answer);
  if (nearmiss_plugin_entry()->version == 2) return ((without_count)(void (*)(void))function)(inputs, answer);
  return function(inputs, count, answer);
}
)";

}  // namespace
}  // namespace plugin_text

Asking ask_plugin(const Case& question, const Subject& subject) {
  using namespace plugin_text;
  const Query& query = *question.query;
  Asking asking;
  asking.style = Asking::Style::c;
  asking.includes = "#include <string.h>\n\n#include \"nearmiss_plugin.h\"\n";
  asking.helpers = helper;
  asking.statements =
      fmt::format("const double inputs[] = {{\n{}}};\n", listed_inputs(question)) +
      fmt::format("const nearmiss_answer_function ask = function_for(\"{}\");\n", query.name) +
      "nearmiss_answer answer;\n"
      "memset(&answer, 0, sizeof answer);\n"
      "answer.given = ~(uint64_t)0;\n"
      "if (ask == NULL || answer_by(ask, inputs, sizeof inputs / sizeof *inputs, &answer) != NEARMISS_ANSWERED) {\n"
      "  printf(\"FAILED: no answer: %.200s\\n\", answer.why);\n"
      "  return 1;\n"
      "}\n";
  asking.statements += take_answer(query, true);
  asking.members = member_names(query);
  asking.build = fmt::format("cc test.c{} {} -lm", include_option("impl/plugin"), shell_quoted(subject.plugin));
  return asking;
}

}  // namespace nearmiss
