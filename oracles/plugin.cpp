#include "oracles/plugin.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <sstream>

#include "impl/plugin/nearmiss_plugin.h"
#include "impl/subject/floating_point.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/query.hpp"

namespace nearmiss {

namespace {

static_assert(NEARMISS_MAX_VALUES == Answer::capacity);
static_assert(sizeof(nearmiss_answer::why) == sizeof(Answer::why));

constexpr std::uint32_t bit_of(Precondition p) { return std::uint32_t{1} << std::size_t(p); }
static_assert(NEARMISS_TRUE_RECTANGLE == bit_of(Precondition::true_rectangle));
static_assert(NEARMISS_UNIT_NORMAL == bit_of(Precondition::unit_normal));
static_assert(NEARMISS_UNIT_DIRECTION == bit_of(Precondition::unit_direction));
static_assert(NEARMISS_UNIT_QUATERNION == bit_of(Precondition::unit_quaternion));
static_assert(NEARMISS_STARTS_OUTSIDE == bit_of(Precondition::starts_outside));
static_assert(NEARMISS_MOVES == bit_of(Precondition::moves));
static_assert(NEARMISS_NO_ZERO_SIZES == bit_of(Precondition::no_zero_sizes));

constexpr unsigned seconds_to_load = 10;

[[noreturn]] void refuse(const std::string& file, const std::string& why) { throw BadPlugin(file + ": " + why); }

using Entry = const nearmiss_plugin* (*)();

Entry entry_of(void* library) { return reinterpret_cast<Entry>(dlsym(library, "nearmiss_plugin_entry")); }

/// Loads it in a child and asks for its description there. Throws BadPlugin where the child does not survive that.
void try_to_load(const std::string& file, const std::string& path) {
  const pid_t child = fork();
  if (child < 0) refuse(file, fmt::format("a process to load it cannot be started: {}", std::strerror(errno)));
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (const int nowhere = open("/dev/null", O_RDWR); nowhere >= 0) {
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
    }
    for (const int s : {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGALRM}) signal(s, SIG_DFL);
    alarm(seconds_to_load);
    if (void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
      if (const Entry entry = entry_of(library)) entry();
    }
    _exit(0);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    refuse(file, fmt::format("loading it took more than {} s", seconds_to_load));
  }
  if (WIFSIGNALED(status)) refuse(file, fmt::format("loading it crashes ({})", strsignal(WTERMSIG(status))));
  if (WEXITSTATUS(status) != 0) refuse(file, fmt::format("loading it ends the process (exit code {})", WEXITSTATUS(status)));
}

/// A library's function, and the modes of floating-point arithmetic that its loading left: it is asked in them, for it
/// would run in them in its user's program. Nothing else does.
struct Asked {
  nearmiss_offer offer;
  FloatingPointModes modes;
};

int given_by(const Asked& asked, std::span<const double> inputs, nearmiss_answer& given) {
  const FloatingPointScope of_the_library(asked.modes);
  return asked.offer.answer(inputs.data(), &given);
}

/// The case goes to the library's function, and its word comes back. Runs in a worker.
Answer ask(const void* asked, std::span<const double> inputs) {
  nearmiss_answer given{};
  given.given = ~std::uint64_t{0};
  const nearmiss_offer& of = static_cast<const Asked*>(asked)->offer;
  const int status = given_by(*static_cast<const Asked*>(asked), inputs, given);
  if (status != NEARMISS_ANSWERED && status != NEARMISS_CANNOT_ANSWER) {
    return Answer::without(Answer::Status::broke, fmt::format("the plugin's function returned {}", status));
  }
  if (status == NEARMISS_CANNOT_ANSWER) {
    return Answer::without(Answer::Status::cannot_answer, {given.why, strnlen(given.why, sizeof given.why)});
  }
  Answer a;
  a.yes = given.yes != 0;
  a.given = given.given;
  a.count = static_cast<std::uint8_t>(of.outputs);
  std::copy_n(std::begin(given.values), a.count, a.values.begin());
  return a;
}

collide::Contract contract_of(const nearmiss_contract* c) {
  if (c == nullptr) return {};
  return {c->backward, c->forward, c->exact_decisions != 0, c->unit, c->lowest, c->highest};
}

std::string text_or(const char* text, const char* otherwise) { return text == nullptr ? otherwise : text; }

void take_offer(const std::string& file, const nearmiss_offer& offer, const FloatingPointModes& modes, Subject& subject) {
  const std::string name = text_or(offer.query, "");
  const Query* query = find_query(name);
  if (query == nullptr) refuse(file, fmt::format("it offers the query '{}', which the catalogue does not have", name));
  if (std::size_t(offer.inputs) != query->inputs.size() || std::size_t(offer.outputs) != query->outputs.size()) {
    refuse(file, fmt::format("{} has {} inputs and {} outputs, and the plugin counts {} and {}", name,
                             query->inputs.size(), query->outputs.size(), offer.inputs, offer.outputs));
  }
  if (offer.answer == nullptr) refuse(file, fmt::format("it offers {} without a function", name));
  for (Offering& o : subject.offerings) {
    if (o.query != name) continue;
    if (o.offer != Offer::not_offered) refuse(file, fmt::format("it offers {} twice", name));
    o.how = text_or(offer.equivalence, "");
    o.offer = o.how.empty() ? Offer::answers : Offer::by_equivalence;
    o.contract = contract_of(offer.contract);
    const collide::Contract& c = o.contract;
    if (!(c.backward >= 0 && c.forward >= 0 && c.unit >= 0)) {
      refuse(file, fmt::format("its contract of {} promises errors of at most {}, {} and {}: none may be below 0", name,
                               c.backward, c.forward, c.unit));
    }
    if (c.lowest > c.highest) {
      refuse(file, fmt::format("its contract of {} has lowest {} above highest {}", name, c.lowest, c.highest));
    }
    if (const std::uint32_t unknown = offer.needs & ~Preconditions::known_bits; unknown != 0) {
      refuse(file, fmt::format("it requires {:#x} for {}, and there is no such bit in nearmiss_plugin.h", unknown, name));
    }
    o.required = Preconditions::of_bits(offer.needs);
    static std::deque<Asked> all;  // workers are told where they lie
    o.answer = AnswerFunction(ask, &all.emplace_back(Asked{offer, modes}));
  }
}

/// Not dereferenced before its version is known.
Subject subject_of(const std::string& file, const nearmiss_plugin* plugin, const FloatingPointModes& modes) {
  if (plugin == nullptr) refuse(file, "nearmiss_plugin_entry() returns no description");
  if (plugin->version != NEARMISS_PLUGIN_VERSION) {
    refuse(file, fmt::format("it is made for version {} of nearmiss_plugin.h, and this is version {}", plugin->version,
                             NEARMISS_PLUGIN_VERSION));
  }
  if (plugin->scalar != NEARMISS_FLOAT && plugin->scalar != NEARMISS_DOUBLE) {
    refuse(file, fmt::format("its scalar is {}: it must be NEARMISS_FLOAT or NEARMISS_DOUBLE", plugin->scalar));
  }
  Subject s;
  s.name = text_or(plugin->name, "");
  if (s.name.empty() || s.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos) {
    refuse(file, fmt::format("its name is '{}': it must be of small letters, digits and '-'", s.name));
  }
  if (find_subject(s.name) != nullptr) refuse(file, fmt::format("there is a subject '{}' already", s.name));
  s.version = text_or(plugin->library_version, "");
  s.scalar = plugin->scalar == NEARMISS_FLOAT ? Scalar::float32 : Scalar::float64;
  s.plugin = std::filesystem::absolute(file).lexically_normal();  // replays from any folder
  for (const Query& q : catalogue()) {
    s.offerings.push_back({std::string(q.name), Offer::not_offered, "the plugin has no function for it", {}, {}});
  }
  if (plugin->offers == nullptr && plugin->offer_count > 0) refuse(file, "it counts offers and has none");
  for (std::size_t i = 0; i < plugin->offer_count; ++i) take_offer(file, plugin->offers[i], modes, s);
  return s;
}

/// What is loaded may set modes of floating-point arithmetic; they end with this.
class ModesBefore {
 public:
  ModesBefore() = default;
  ~ModesBefore() { before_.set(); }
  ModesBefore(const ModesBefore&) = delete;
  ModesBefore& operator=(const ModesBefore&) = delete;

 private:
  FloatingPointModes before_ = FloatingPointModes::current();
};

}  // namespace

void load_plugin(const std::string& file) {
  const ModesBefore modes_before;
  std::error_code error;
  if (file.empty()) refuse("--plugin", "the name of its file is empty");
  if (!std::filesystem::exists(file, error)) refuse(file, "there is no such file");
  if (!std::filesystem::is_regular_file(file, error)) refuse(file, "it is not a file");
  const std::string path = std::filesystem::absolute(file);  // without a slash it would be looked for elsewhere
  try_to_load(file, path);
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::string why = dlerror();
    if (why.starts_with(path + ": ")) why.erase(0, path.size() + 2);
    refuse(file, "it cannot be loaded: " + why);
  }
  const Entry entry = entry_of(library);
  if (entry == nullptr) refuse(file, "it is no plugin: it has no function nearmiss_plugin_entry");
  const nearmiss_plugin* plugin = entry();
  const FloatingPointModes modes = FloatingPointModes::current();
  FloatingPointModes::standard().set();
  add_subject(subject_of(file, plugin, modes));
}

void load_plugins_of_environment() {
  const char* named = std::getenv(plugins_variable);
  std::istringstream files(named == nullptr ? "" : named);
  for (std::string file; std::getline(files, file, ':');) {
    if (!file.empty()) load_plugin(file);
  }
}

}  // namespace nearmiss
