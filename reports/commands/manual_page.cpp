#include "reports/commands/manual_page.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view indent = "    ", deep = "        ";

std::string heading(std::string_view text) { return fmt::format("\n{}\n", text); }

/// Each left part on a line of its own, its meaning below.
std::string definitions(const std::vector<Manual::Line>& lines) {
  std::string text;
  for (const Manual::Line& l : lines) text += fmt::format("{}{}\n", indent, l.left) + wrapped_text(l.right, deep);
  return text;
}

std::string option_name(const CLI::Option& o) {
  const std::string type = o.get_type_name();
  if (o.get_positional()) return o.get_name() + (o.get_items_expected_max() > 1 ? " ..." : "");
  std::string names;
  for (const std::string& s : o.get_snames()) names += (names.empty() ? "-" : ", -") + s;
  for (const std::string& l : o.get_lnames()) names += (names.empty() ? "--" : ", --") + l;
  return type.empty() || o.get_items_expected_max() == 0 ? names : names + " " + type;
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* o : app.get_options()) {
    if (o->get_positional() == positional) options.push_back(o);
  }
  return options;
}

std::string synopsis(const CLI::App& app) {
  std::string text = "nearmiss " + app.get_name() + " [OPTION]...";
  for (const CLI::Option* o : options_of(app, true)) {
    const std::string name = o->get_name() + (o->get_items_expected_max() > 1 ? "..." : "");
    text += o->get_required() ? " " + name : " [" + name + "]";
  }
  return text;
}

std::string paragraphs(const std::vector<std::string>& all) {
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) text += (i > 0 ? "\n" : "") + wrapped_text(all[i], indent);
  return text;
}

std::string options_text(const CLI::App& app) {
  std::vector<Manual::Line> lines;
  for (const bool positional : {true, false}) {
    for (const CLI::Option* o : options_of(app, positional)) {
      lines.push_back(
          {option_name(*o), o->get_description() + (o->get_required() && !positional ? ". Required" : "") + "."});
    }
  }
  return definitions(lines);
}

}  // namespace

std::string manual_page(const CLI::App& command, const Manual& manual) {
  std::string text = fmt::format("NAME\n{}nearmiss {} - {}\n", indent, manual.name, manual.summary);
  text += heading("SYNOPSIS") + std::string(indent) + synopsis(command) + "\n";
  text += heading("DESCRIPTION") + paragraphs(manual.description);
  text += heading("OPTIONS") + options_text(command);
  text += heading("EXIT STATUS") + definitions(manual.exit_status);
  if (!manual.examples.empty()) text += heading("EXAMPLES") + definitions(manual.examples);
  return text;
}

std::string overview_page(const CLI::App& root) {
  std::vector<std::vector<std::string>> commands;
  for (const CLI::App* c : root.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back({c->get_name(), c->get_description()});
  }
  std::string text = fmt::format("NAME\n{}nearmiss - {}\n", indent, root.get_description());
  text += heading("SYNOPSIS") + std::string(indent) + "nearmiss COMMAND [OPTION]...\n";
  text += heading("DESCRIPTION") +
          paragraphs(
              {"Nearmiss asks a collision-detection library many questions, knows the exact answers, and reports "
               "where the library is wrong, by how much, and with what proof. A query is one operation with a "
               "fixed meaning. A subject is a library that answers queries. A contract is the subject's promise, and "
               "a violation is a proved breach of it.",
               "The launcher ./nearmiss of the source tree also has the commands check, build and engines; "
               "'./nearmiss help check' prints their manuals."});
  text += heading("COMMANDS") + table_text(commands, indent);
  text += heading("OPTIONS") + options_text(root);
  text += heading("EXIT STATUS") + definitions(judging_exit_status());
  text +=
      heading("ENVIRONMENT") +
      definitions({{"NEARMISS_RUNS", "The folder for runs without --out, instead of reports/runs of the source tree."},
                   {"NEARMISS_CORPUS", "The folder of stored cases, instead of corpus of the source tree."},
                   {"NEARMISS_SOURCES", "The source tree, where it was moved after the build."}});
  text += heading("EXAMPLES") +
          definitions({{"nearmiss list", "The queries, and the subjects that answer them."},
                       {"nearmiss run --subject fcl --query moving_sphere_box", "Is FCL right about moving spheres?"},
                       {"nearmiss help run", "The manual of a command."}});
  return text;
}

}  // namespace nearmiss
