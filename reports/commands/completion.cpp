#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "reports/commands/command.hpp"
#include "reports/engine/output.hpp"

namespace nearmiss {

namespace {

/// All names of an app's options, separated by spaces.
std::string option_words(const CLI::App& app) {
  std::string words;
  for (const CLI::Option* o : app.get_options()) {
    for (const std::string& s : o->get_snames()) words += " -" + s;
    for (const std::string& l : o->get_lnames()) words += " --" + l;
  }
  return words.substr(words.empty() ? 0 : 1);
}

/// `@…@` are filled in below.
constexpr std::string_view bash_script =
    R"bash(# Bash completion for nearmiss: source it, or put it into a folder of bash-completion.
_nearmiss() {
  local program=${COMP_WORDS[0]} current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=
  local i
  for ((i = 1; i < COMP_CWORD; i++)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then
      command=${COMP_WORDS[i]}
      break
    fi
  done
  case $previous in
    -q|--query) COMPREPLY=($(compgen -W "$("$program" list --names queries 2>/dev/null)" -- "$current")); return ;;
    -s|--subject) COMPREPLY=($(compgen -W "$("$program" list --names subjects 2>/dev/null)" -- "$current")); return ;;
    -o|--out|--fuzz-targets) COMPREPLY=($(compgen -d -- "$current")); return ;;
    --case) COMPREPLY=($(compgen -f -- "$current")); return ;;
    --names) COMPREPLY=($(compgen -W "queries subjects" -- "$current")); return ;;
  esac
  local words=
  case $command in
    '') words="@commands@ @root@" ;;
    help) words="@commands@" ;;
@cases@
  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  if [[ $current != -* && ($command == replay || $command == import) ]]; then
    compopt -o filenames 2>/dev/null
    COMPREPLY+=($(compgen -f -- "$current"))
  fi
}
complete -F _nearmiss nearmiss ./nearmiss
)bash";

void fill(std::string& text, std::string_view place, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += with.size()) {
    text.replace(at, place.size(), with);
  }
}

class CompletionCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "completion",
        "print a script that completes commands, options and names in a shell",
        {"SHELL is bash. The script gets the names of queries and subjects from this program, so it includes "
         "added ones."},
        {{"0", "Done."}, {"2", "Another shell was asked for."}},
        {{"source <(nearmiss completion bash)", "For this shell."},
         {"nearmiss completion bash > ~/.local/share/bash-completion/completions/nearmiss", "For all future shells."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("SHELL", shell_, "The shell: bash")
        ->required()
        ->type_name("")
        ->check(CLI::Validator(
            [](const std::string& t) {
              return t == "bash" ? "" : "there is no completion for '" + t + "', only for bash";
            },
            ""));
  }
  int run(const CLI::App& root) override {
    std::string commands, cases, script(bash_script);
    for (const CLI::App* c : root.get_subcommands([](const CLI::App*) { return true; })) {
      commands += (commands.empty() ? "" : " ") + c->get_name();
      if (c->get_name() == "help") continue;
      std::string words = option_words(*c);
      if (c->get_name() == "import") words += " nyu-ccd";
      if (c->get_name() == "completion") words += " bash";
      cases += fmt::format("{}    {}) words=\"{}\" ;;", cases.empty() ? "" : "\n", c->get_name(), words);
    }
    fill(script, "@commands@", commands);
    fill(script, "@cases@", cases);
    fill(script, "@root@", option_words(root));
    say("{}", script);
    return 0;
  }

 private:
  std::string shell_;
};

}  // namespace

std::unique_ptr<Command> completion_command() { return std::make_unique<CompletionCommand>(); }

}  // namespace nearmiss
