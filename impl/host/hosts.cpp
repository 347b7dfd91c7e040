#include "impl/host/hosts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "impl/catalogue/query.hpp"
#include "impl/host/engines.hpp"
#include "impl/host/replies.hpp"
#include "impl/host/separation.hpp"
#include "impl/host/shared_layout.hpp"
#include "impl/subject/printable.hpp"
#include "impl/subject/provenance.hpp"
#include "impl/subject/standard.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::json;

constexpr std::size_t most_of_a_name = 64, most_of_a_text = 500;

/// Reports an error in a hello.
struct BadHello : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class... Arguments>
[[noreturn]] void refuse(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  throw BadHello(fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// A JSON object in a hello. Throws BadHello for a member that is not known.
class Members {
 public:
  Members(const Json& object, std::string path, std::initializer_list<std::string_view> known)
      : object_(object), path_(std::move(path)) {
    if (!object.is_object()) refuse("{} is no object", path_);
    for (const auto& [name, value] : object.items()) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        refuse("{} has '{}', which is none of: {}", path_, name.substr(0, most_of_a_name), fmt::join(known, ", "));
      }
    }
  }
  std::string text(const char* name, const std::string& otherwise = "", std::size_t most = most_of_a_text) const {
    const Json* j = find(name);
    if (j == nullptr) return otherwise;
    if (!j->is_string()) refuse("{} is no text", of(name));
    const auto& text = j->get_ref<const std::string&>();
    if (text.size() > most) refuse("{} has {} bytes, more than {}", of(name), text.size(), most);
    return printable(text);
  }
  bool flag(const char* name) const {
    const Json* j = find(name);
    if (j != nullptr && !j->is_boolean()) refuse("{} is neither true nor false", of(name));
    return j != nullptr && j->get<bool>();
  }
  std::optional<int> whole(const char* name) const {
    const Json* j = find(name);
    if (j == nullptr) return std::nullopt;
    constexpr double most = 1e6;
    if (!j->is_number_integer() || std::abs(j->get<double>()) > most)
      refuse("{} is no whole number within a million", of(name));
    return j->get<int>();
  }
  /// Infinity where the member is null or missing.
  double bound(const char* name) const {
    const Json* j = find(name);
    if (j == nullptr || j->is_null()) return std::numeric_limits<double>::infinity();
    if (!j->is_number()) refuse("{} is neither a number nor null", of(name));
    return j->get<double>();
  }
  const Json* find(const char* name) const {
    const auto at = object_.find(name);
    return at == object_.end() ? nullptr : &*at;
  }
  const Json& list(const char* name) const {
    static const Json none = Json::array();
    const Json* j = find(name);
    if (j == nullptr) return none;
    if (!j->is_array()) refuse("{} is no list", of(name));
    return *j;
  }

 private:
  std::string of(const char* name) const { return fmt::format("{}'s \"{}\"", path_, name); }
  const Json& object_;
  std::string path_;
};

collide::Contract contract_in(const Json* j, const std::string& query) {
  if (j == nullptr || j->is_null()) return {};
  const Members m(*j, fmt::format("its contract of {}", query),
                  {"backward", "forward", "unit", "exact_decisions", "lowest", "highest"});
  collide::Contract c;
  c.backward = m.bound("backward"), c.forward = m.bound("forward"), c.unit = m.bound("unit");
  c.exact_decisions = m.flag("exact_decisions");
  c.lowest = m.whole("lowest").value_or(c.lowest), c.highest = m.whole("highest").value_or(c.highest);
  if (!(c.backward >= 0 && c.forward >= 0 && c.unit >= 0)) {
    refuse("its contract of {} promises errors of at most {}, {} and {}: none may be below 0", query, c.backward,
           c.forward, c.unit);
  }
  const bool has_domain = c.lowest != collide::Contract().lowest || c.highest != collide::Contract().highest;
  if (has_domain && promises_nothing(c))
    refuse("its contract of {} has a domain, from 2^{} to 2^{}, and promises nothing there", query, c.lowest,
           c.highest);
  if (c.lowest > c.highest) refuse("its contract of {} has lowest {} above highest {}", query, c.lowest, c.highest);
  return c;
}

Preconditions requirements_in(const Json& list, const std::string& query) {
  Preconditions required;
  for (const Json& j : list) {
    if (!j.is_string()) refuse("what it requires for {} has an entry that is no text", query);
    const auto& name = j.get_ref<const std::string&>();
    const auto is_it = [&](Precondition p) { return name_of(p) == name; };
    const auto found = std::find_if(all_preconditions.begin(), all_preconditions.end(), is_it);
    if (found == all_preconditions.end()) {
      std::vector<std::string_view> names;
      for (const Precondition p : all_preconditions) names.push_back(name_of(p));
      refuse("it requires '{}' for {}, which is none of {}", name.substr(0, most_of_a_name), query,
             fmt::join(names, ", "));
    }
    required.add(*found);
  }
  return required;
}

/// An entry of a list of conventions: its name, or an object with the name and a sentence of the documentation.
Declaration declaration_in(const Json& j, const Query& query) {
  std::string name, sentence;
  if (j.is_object()) {
    const Members m(j, fmt::format("what it declares for {}", query.name), {"convention", "sentence"});
    name = m.text("convention"), sentence = m.text("sentence");
  } else if (j.is_string()) {
    name = j.get<std::string>();
  } else {
    refuse("what it declares for {} has an entry that is neither a text nor an object", query.name);
  }
  const auto convention = convention_named(name);
  if (!convention) {
    refuse("it declares '{}' for {}, which is none of {}", name.substr(0, most_of_a_name), query.name,
           convention_names());
  }
  if (!concerns(*convention, query)) refuse("it declares '{}' for {}, where it has no effect", name, query.name);
  return {*convention, sentence};
}

std::vector<Declaration> declarations_in(const Json& list, const Query& query) {
  std::vector<Declaration> declared;
  Conventions all;
  for (const Json& j : list) {
    declared.push_back(declaration_in(j, query));
    if (const auto other = contradicted(declared.back().convention, all)) {
      refuse("it declares '{}' and '{}' for {}, which contradict each other", name_of(*other),
             name_of(declared.back().convention), query.name);
    }
    all.add(declared.back().convention);
  }
  return declared;
}

/// Checks the names of the outputs that an offer gives (wire::given_by_offers).
void check_given(const Json& list, const Query& query) {
  for (const Json& j : list) {
    if (j.is_string() && wire::bits_of_output(query, j.get_ref<const std::string&>()) != 0) continue;
    std::vector<std::string_view> names;
    for (const Field& f : query.outputs) names.push_back(f.name);
    const std::string name = j.is_string() ? j.get<std::string>() : j.dump();
    refuse("it gives '{}' for {}, whose outputs are: {}", name.substr(0, most_of_a_name), query.name,
           names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
  }
}

/// The context of the function that asks a host without a Worker of the caller.
struct HostedOffer {
  std::shared_ptr<const HostProgram> host;
  Offering offering;
};
using HostedOffers = std::deque<HostedOffer>;  // functions keep pointers to the elements

Answer ask_hosted(const void* offer, std::span<const double> inputs) {
  static std::map<const HostProgram*, std::unique_ptr<Worker>> workers;
  const auto& [host, offering] = *static_cast<const HostedOffer*>(offer);
  std::unique_ptr<Worker>& worker = workers[host.get()];
  if (!worker) worker = std::make_unique<Worker>(worker_limits(), host);
  return worker->ask(offering, inputs, inputs.size()).front();
}

/// The inputs of a query with lists are counted where each list has its fewest entries.
void take_offer(const Json& j, std::uint32_t position, Subject& subject, HostedOffers& hosted) {
  const Members m(j, fmt::format("offer {}", position + 1),
                  {"query", "inputs", "outputs", "by_equivalence", "how", "contract", "requires", "gives", "declares"});
  const std::string name = m.text("query");
  const Query* query = find_query(name);
  if (query == nullptr) refuse("it offers the query '{}', which the catalogue does not have", name);
  if (!query->lists.empty() && subject.host->version == wire::version_without_lengths) {
    refuse("it offers {}, whose cases differ in their counts of numbers, and it speaks version {} of the protocol",
           name, wire::version_without_lengths);
  }
  const int inputs = m.whole("inputs").value_or(int(query->inputs.size()));
  const int outputs = m.whole("outputs").value_or(int(query->outputs.size()));
  if (std::size_t(inputs) != query->inputs.size() || std::size_t(outputs) != query->outputs.size()) {
    refuse("{} has {} inputs and {} outputs, and its hello says {} and {}", name, query->inputs.size(),
           query->outputs.size(), inputs, outputs);
  }
  for (Offering& o : subject.offerings) {
    if (o.query != name) continue;
    if (o.offer != Offer::not_offered) refuse("it offers {} twice", name);
    o.how = m.text("how");
    o.offer = m.flag("by_equivalence") ? Offer::by_equivalence : Offer::answers;
    o.contract = contract_in(m.find("contract"), name);
    o.required = requirements_in(m.list("requires"), name);
    o.declare(declarations_in(m.list("declares"), *query));
    o.position = position;
    o.outputs = std::uint32_t(outputs);
    check_given(m.list("gives"), *query);
    o.decides = decides(query->kind);
    o.answer = AnswerFunction(ask_hosted, &hosted.emplace_back(HostedOffer{subject.host, o}));
  }
}

HostProgram::Batches batches_in(const std::string& word, bool may_share) {
  if (may_share) {
    if (word != "shared") refuse("its \"batches\" is '{}', and a host of this project has \"shared\"", word);
    return HostProgram::Batches::shared;
  }
  if (word == "json") return HostProgram::Batches::json;
  if (word == "binary") return HostProgram::Batches::binary;
  refuse("its \"batches\" is '{}': it must be \"json\" or \"binary\"", word);
}

/// A host that was built before or after this program.
void check_layout(const std::string& stated) {
  if (stated == shared_layout(catalogue())) return;
  refuse(
      "its host is of another build than this program; build all of it again, and check that nothing else builds or "
      "copies there");
}

/// Names are words of the command line, and parts of file names.
void check_name(const std::string& name) {
  if (name.empty() || name.size() > most_of_a_name ||
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos) {
    refuse("its name is '{}': it must be of small letters, digits and '-', at most {}", name, most_of_a_name);
  }
  if (name.front() == '-' || name.back() == '-')
    refuse("its name is '{}': it must begin and end with a letter or a digit", name);
  if (name == "added") refuse("its name is 'added', the word for the subjects of NEARMISS_ADD");
}

Subject described(std::string_view hello, HostProgram program) {
  if (wire::nesting(hello) > wire::most_nested) refuse("its hello is nested more than {} deep", wire::most_nested);
  const Json j = Json::parse(hello, nullptr, false);
  if (j.is_discarded())
    refuse("what it says first is no JSON: {}", hello.substr(0, std::min<std::size_t>(hello.find('\n'), 60)));
  if (const auto twice = wire::repeated_member(hello, j))
    refuse("its hello has '{}' twice in one object", twice->substr(0, most_of_a_name));
  const bool may_share = program.batches == HostProgram::Batches::shared;
  const Members m =
      may_share
          ? Members(j, "its hello",
                    {"nearmiss", "refused", "name", "version", "scalar", "batches", "layout", "offers", "not_offered"})
          : Members(j, "its hello",
                    {"nearmiss", "refused", "name", "version", "scalar", "batches", "names", "offers", "not_offered"});
  const std::optional<int> version = m.whole("nearmiss");
  if (!version) refuse("its hello has no \"nearmiss\", the version of the protocol that it speaks");
  if (*version != wire::version && (may_share || *version != wire::version_without_lengths))
    refuse("it speaks version {} of the protocol, and this is version {}", *version, wire::version);
  if (const std::string why = m.text("refused"); !why.empty()) refuse("{}", why);
  if (may_share) check_layout(m.text("layout"));
  Subject s;
  s.name = m.text("name");
  check_name(s.name);
  s.version = m.text("version");
  const std::string scalar = m.text("scalar");
  if (scalar != "float" && scalar != "double") refuse("its scalar is '{}': it must be \"float\" or \"double\"", scalar);
  s.scalar = scalar == "float" ? Scalar::float32 : Scalar::float64;
  program.batches = batches_in(m.text("batches"), may_share);
  program.version = *version;
  program.asks_for_names = m.flag("names");
  program.hello = hello;
  s.host = std::make_shared<const HostProgram>(std::move(program));
  const Json* not_offered = m.find("not_offered");
  if (not_offered != nullptr && !not_offered->is_object()) refuse("its \"not_offered\" is no object");
  for (const Query& q : catalogue()) {
    Offering& o = s.offerings.emplace_back();
    o.query = q.name;
    o.how = "it is not among its offers";
    if (not_offered == nullptr) continue;
    if (const auto why = not_offered->find(q.name); why != not_offered->end() && why->is_string())
      o.how = printable(why->get<std::string>().substr(0, most_of_a_text));
  }
  const auto hosted = std::make_shared<HostedOffers>();
  std::uint32_t position = 0;
  if (!may_share && m.list("offers").empty()) refuse("it offers nothing: its \"offers\" is empty");
  for (const Json& offer : m.list("offers")) take_offer(offer, position++, s, *hosted);
  s.context = hosted;
  return s;
}

std::string host_of_plugins() { return NEARMISS_HOSTS "/plugin"; }

/// Why a host may have failed: its user cannot reach one of the words that name files, or the current folder. Empty
/// where it can.
std::string advice_for(const std::vector<std::string>& words) {
  if (!user_for_a_host()) return {};
  const auto look = [&] {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (access(words[i].c_str(), R_OK) != 0 && errno == EACCES) return int(i) + 1;
    }
    return access(".", X_OK) == 0 ? 0 : int(words.size()) + 1;
  };
  SupervisedProcess looks({.arguments = {}, .body = look});
  constexpr int most = 5000;  // milliseconds
  if (!looks.has_ended(most)) return {};
  const auto at = std::size_t(looks.exit_code().value_or(0));
  if (at == 0 || at > words.size() + 1) return {};
  return "; " + advice_about_unreachable(at <= words.size() ? words[at - 1] : "the current folder");
}

/// NAME, or NAME-2, NAME-3 … where there is such a subject.
std::string free_name(const std::string& name) {
  std::string found = name;
  for (int number = 2; is_subject(found); ++number) found = fmt::format("{}-{}", name, number);
  return found;
}

/// Adds the subject that the program's hello describes, and returns its name.
std::string add_hosted(const std::string& where, HostProgram program, SameName rule, const std::string& plugin,
                       const std::string& command) {
  std::string hello;
  try {
    hello = Worker(worker_limits(), std::make_shared<const HostProgram>(program)).hello();
  } catch (const HostFailed& e) {
    const std::string_view said_nothing =
        plugin.empty() && e.why == HostFailed::done
            ? ". It never said hello: with nearmiss.py or nearmiss.mjs, call their function answer"
            : "";
    const std::string advice = plugin.empty() ? advice_for(program.arguments) : "";
    throw BadSubject(fmt::format("{}: {}{}{}", where, e.what(), said_nothing, advice));
  }
  Subject s = subject_from_hello(where, hello, std::move(program));
  const std::string name = rule == SameName::numbered ? free_name(s.name) : s.name;
  if (is_subject(name)) throw BadSubject(fmt::format("{}: there is a subject '{}' already", where, s.name));
  s.name = name;
  s.plugin = plugin;
  s.command = command;
  add_subject(std::move(s));
  return name;
}

std::vector<std::string> parts_of(const char* text, char separator) {
  std::vector<std::string> parts;
  std::istringstream all(text == nullptr ? "" : text);
  for (std::string part; std::getline(all, part, separator);) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

/// The words of a simple command, split as a shell splits them; for any other command (pipes, assignments, several
/// commands) the words that run it in a shell. A simple command runs without a shell, because the processor time and
/// the signal of a program are known only without a shell in between.
std::vector<std::string> words_of(const std::string& command) {
  const std::vector<std::string> by_shell{"/bin/sh", "-c", command};
  wordexp_t words{};
  const int error = wordexp(command.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF);
  if (error == WRDE_NOSPACE) wordfree(&words);
  if (error != 0) return by_shell;
  std::vector<std::string> all(words.we_wordv, words.we_wordv + words.we_wordc);
  wordfree(&words);
  if (all.empty() || all.front().find('=') != std::string::npos) return by_shell;
  for (const char* builtin : {"exec", ".", "eval", "if", "while", "until", "for", "case", "!"}) {
    if (all.front() == builtin) return by_shell;
  }
  return all;
}

std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    if (c == '\'') all += "'\\'";
    all += c;
  }
  return all + "'";
}

/// The command in a form that runs from any folder: it changes to this folder where a word names a file here.
std::string from_any_folder(const std::string& command, const std::vector<std::string>& words) {
  const bool by_shell = words.front() == "/bin/sh";
  const auto names_a_file_here = [](const std::string& word) {
    std::error_code error;
    return !word.starts_with('/') && std::filesystem::exists(word, error);
  };
  if (!by_shell && std::none_of(words.begin(), words.end(), names_a_file_here)) return command;
  std::error_code error;
  const std::string here = std::filesystem::current_path(error).string();
  if (error) return command;
  return fmt::format("cd {} && {}{}", quoted(here), by_shell ? "" : "exec ", command);
}

/// How an engine's subject is started.
HostProgram program_of(const Engine& engine) {
  const bool is_usual = engine.setting.empty();
  if (engine.is_plugin)
    return {{host_of_plugins(), engine.folder + "/subject" + (is_usual ? "" : "-" + engine.setting) + ".so"}};
  HostProgram program{{"node", engine.sources + "/subject.mjs", engine.folder}, HostProgram::Batches::json};
  if (!is_usual) program.arguments.insert(program.arguments.end(), {"--setting", engine.setting});
  return program;
}

/// The subject that the hello of an engine describes. Throws BadSubject.
Subject said_by(const Engine& engine, Worker& worker) {
  const std::string where = fmt::format("the engine {}", engine.name);
  try {
    Subject s = subject_from_hello(where, worker.hello(), program_of(engine));
    if (s.name == engine.name) return s;
    throw BadSubject(fmt::format("{}: its hello has the name '{}'", where, s.name));
  } catch (const HostFailed& e) {
    throw BadSubject(fmt::format("{}: {}{}", where, e.what(), advice_for(program_of(engine).arguments)));
  }
}

std::unique_ptr<Worker> begun(const HostOfBuild& host) {
  auto worker =
      std::make_unique<Worker>(worker_limits(), std::make_shared<const HostProgram>(HostProgram{{host.file}}));
  worker->begin();
  return worker;
}

/// The subject that the host's hello describes. Throws BadSubject.
Subject said_by(const HostOfBuild& host, Worker& worker) {
  const std::string where = fmt::format("the subject {} of this build", host.name);
  try {
    return subject_from_hello(where, worker.hello(), {{host.file}});
  } catch (const HostFailed& e) {
    throw BadSubject(fmt::format("{}: {}", where, e.what()));
  }
}

/// Runs `LAUNCHER build NAME...`, which shows its progress on standard error. Throws BadSubject.
void have_built(const std::string& launcher, const std::vector<HostOfBuild>& hosts) {
  std::vector<std::string> words{launcher, "build"};
  for (const HostOfBuild& h : hosts) words.push_back(h.name);
  std::vector<char*> arguments;
  for (std::string& w : words) arguments.push_back(w.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  int error = posix_spawn(&process, launcher.c_str(), nullptr, nullptr, arguments.data(), environ);
  int status = 0;
  while (error == 0 && waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) error = errno;
  }
  if (error != 0) throw BadSubject(fmt::format("{}: {}", launcher, std::strerror(error)));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  words.erase(words.begin(), words.begin() + 2);
  throw BadSubject(fmt::format("{} could not build {}", launcher, fmt::join(words, ", ")));
}

}  // namespace

Subject subject_from_hello(const std::string& where, std::string_view hello, HostProgram program) {
  try {
    return described(hello, std::move(program));
  } catch (const BadHello& e) {
    throw BadSubject(fmt::format("{}: {}", where, e.what()));
  }
}

std::string load_plugin(const std::string& file, SameName rule) {
  const auto refuse_file = [&](const char* why) { throw BadSubject(fmt::format("{}: {}", file, why)); };
  std::error_code error;
  if (file.empty()) throw BadSubject("--plugin: the name of its file is empty");
  if (!std::filesystem::exists(file, error)) refuse_file("there is no such file");
  if (!std::filesystem::is_regular_file(file, error)) refuse_file("it is not a file");
  const std::string path = std::filesystem::absolute(file).lexically_normal();  // replays from any folder
  return add_hosted(file, {{host_of_plugins(), path}}, rule, path, "");
}

std::string load_command(const std::string& command, SameName rule) {
  if (command.find_first_not_of(" \t\n") == std::string::npos) throw BadSubject("--command: the command is empty");
  const std::vector<std::string> words = words_of(command);
  return add_hosted(command, {words, HostProgram::Batches::json}, rule, "", from_any_folder(command, words));
}

void load_subjects_of_environment() {
  for (const std::string& file : parts_of(std::getenv(plugins_variable), ':')) load_plugin(file);
  for (const std::string& command : parts_of(std::getenv(commands_variable), '\n')) load_command(command);
}

std::vector<std::string> installed_engines() {
  std::vector<std::string> names;
  for (const Engine& e : engines()) {
    if (e.is_installed) names.push_back(e.name);
  }
  return names;
}

std::vector<Subject> start_engines(const std::vector<std::string>& names) {
  std::vector<std::pair<Engine, std::unique_ptr<Worker>>> started;
  for (Engine& e : engines()) {
    if (std::find(names.begin(), names.end(), e.name) == names.end()) continue;
    auto worker = std::make_unique<Worker>(worker_limits(), std::make_shared<const HostProgram>(program_of(e)));
    worker->begin();
    started.emplace_back(std::move(e), std::move(worker));
  }
  std::vector<Subject> all;
  for (auto& [engine, worker] : started) {
    all.push_back(said_by(engine, *worker));
    worker.reset();
  }
  return all;
}

std::vector<Subject> hosted(const std::vector<HostOfBuild>& hosts) {
  std::vector<std::unique_ptr<Worker>> workers;
  for (const HostOfBuild& h : hosts) workers.push_back(begun(h));
  std::vector<Subject> all;
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    all.push_back(said_by(hosts[i], *workers[i]));
    workers[i].reset();
  }
  return all;
}

std::vector<Subject> built_and_hosted(const std::vector<HostOfBuild>& hosts) {
  if (const char* launcher = std::getenv(launcher_variable); launcher != nullptr && *launcher != 0) {
    have_built(launcher, hosts);
  }
  for (const HostOfBuild& h : hosts) {
    std::error_code error;
    if (std::filesystem::exists(h.file, error)) continue;
    throw BadSubject(
        fmt::format("the subject {} of this build is not built: there is no {}; './nearmiss build {}' in "
                    "the source tree builds it",
                    h.name, h.file, h.name));
  }
  return hosted(hosts);
}

std::vector<Subject> hosted_at_hand(const std::vector<HostOfBuild>& hosts) {
  std::vector<std::pair<const HostOfBuild*, std::unique_ptr<Worker>>> started;
  for (const HostOfBuild& h : hosts) {
    std::error_code error;
    if (std::filesystem::exists(h.file, error)) started.emplace_back(&h, begun(h));
  }
  std::vector<Subject> all;
  for (auto& [host, worker] : started) {
    try {
      all.push_back(said_by(*host, *worker));
    } catch (const BadSubject&) {  // built before this program: the launcher builds it anew when it is asked
    }
    worker.reset();
  }
  return all;
}

}  // namespace nearmiss
