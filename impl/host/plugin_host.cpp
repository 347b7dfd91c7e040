// The host of a plugin: loads the shared library that its argument names, sends the library's description as the hello,
// and calls its functions.
#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "impl/catalogue/query.hpp"
#include "impl/host/separation.hpp"
#include "impl/host/serve.hpp"
#include "impl/plugin/nearmiss_plugin.h"
#include "impl/subject/floating_point.hpp"

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

/// Bounds that no valid plugin reaches.
constexpr std::size_t most_offers = 4096, most_text = 4096;

using Entry = const nearmiss_plugin* (*)();
using Declarations = const nearmiss_declaration* (*)();
constexpr std::size_t most_declarations = 4096;

/// The version before the functions had the count of their inputs, and such a function.
constexpr int version_without_counts = 2;
using FunctionWithoutCount = int (*)(const double* inputs, nearmiss_answer* answer);

/// A function of the library, and the floating-point modes that loading the library left. The function runs in these
/// modes, as it would in its user's program. No other code does. For a case that is asked in another rounding than to
/// nearest, that rounding replaces the library's.
struct AskedFunction {
  nearmiss_offer offer;
  FloatingPointModes modes;
  bool takes_count;

  int operator()(std::span<const double> inputs, nearmiss_answer& given) const {
    if (takes_count) return offer.answer(inputs.data(), inputs.size(), &given);
    const auto any = reinterpret_cast<void (*)()>(offer.answer);
    return reinterpret_cast<FunctionWithoutCount>(any)(inputs.data(), &given);
  }
};

int given_by(const AskedFunction& asked, std::span<const double> inputs, nearmiss_answer& given) {
  const int rounding = std::fegetround();
  int status, raised;
  {
    const FloatingPointScope of_the_library(asked.modes);
    if (rounding != FE_TONEAREST) std::fesetround(rounding);
    status = asked(inputs, given);
    raised = std::fetestexcept(FE_ALL_EXCEPT);
  }
  std::feraiseexcept(raised);
  return status;
}

/// Calls the library's function for one case and returns its answer.
Answer ask(const void* asked, std::span<const double> inputs) {
  nearmiss_answer given{};
  given.given = ~std::uint64_t{0};
  const nearmiss_offer& of = static_cast<const AskedFunction*>(asked)->offer;
  const int status = given_by(*static_cast<const AskedFunction*>(asked), inputs, given);
  if (status != NEARMISS_ANSWERED && status != NEARMISS_CANNOT_ANSWER) {
    return Answer::without(Answer::Status::broke, "the plugin's function returned " + std::to_string(status));
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

std::string text_or_none(const char* text) {
  return text == nullptr ? "" : std::string(text, strnlen(text, most_text));
}

collide::Contract contract_of(const nearmiss_contract* c) {
  if (c == nullptr) return {};
  return {c->backward, c->forward, c->exact_decisions != 0, c->unit, c->lowest, c->highest};
}

/// The library's description, copied unchecked: the judge's process checks the hello.
Subject described_by(const nearmiss_plugin& plugin, const FloatingPointModes& modes,
                     std::vector<AskedFunction>& functions) {
  Subject s;
  s.name = text_or_none(plugin.name);
  s.version = text_or_none(plugin.library_version);
  s.scalar = plugin.scalar == NEARMISS_FLOAT ? Scalar::float32 : Scalar::float64;
  functions.reserve(plugin.offer_count);  // the subject's functions keep pointers to the elements
  for (std::size_t i = 0; i < plugin.offer_count; ++i) {
    const nearmiss_offer& offer = plugin.offers[i];
    Offering o;
    o.query = text_or_none(offer.query);
    o.how = text_or_none(offer.equivalence);
    o.offer = o.how.empty() ? Offer::answers : Offer::by_equivalence;
    o.contract = contract_of(offer.contract);
    o.required = Preconditions::of_bits(offer.needs);
    o.counts = {offer.inputs, offer.outputs};
    o.answer = AnswerFunction(
        ask, &functions.emplace_back(AskedFunction{offer, modes, plugin.version != version_without_counts}));
    s.offerings.push_back(o);
  }
  return s;
}

/// The error in a plugin's description; empty where it has none. Reads no other member before the version is known.
std::string fault_of(const nearmiss_plugin* plugin) {
  if (plugin == nullptr) return "nearmiss_plugin_entry() returns no description";
  if (plugin->version != NEARMISS_PLUGIN_VERSION && plugin->version != version_without_counts) {
    return "it is made for version " + std::to_string(plugin->version) + " of nearmiss_plugin.h, and this is version " +
           std::to_string(NEARMISS_PLUGIN_VERSION);
  }
  if (plugin->scalar != NEARMISS_FLOAT && plugin->scalar != NEARMISS_DOUBLE) {
    return "its scalar is " + std::to_string(plugin->scalar) + ": it must be NEARMISS_FLOAT or NEARMISS_DOUBLE";
  }
  if (plugin->offers == nullptr && plugin->offer_count > 0) return "it counts offers and has none";
  if (plugin->offer_count > most_offers) {
    return "it counts " + std::to_string(plugin->offer_count) + " offers, more than " + std::to_string(most_offers);
  }
  const bool takes_counts = plugin->version != version_without_counts;
  for (std::size_t i = 0; i < plugin->offer_count; ++i) {
    const nearmiss_offer& offer = plugin->offers[i];
    const std::string query = text_or_none(offer.query);
    if (offer.answer == nullptr) return "it offers " + query + " without a function";
    if (const Query* known = find_query(query); known != nullptr && !known->lists.empty() && !takes_counts) {
      return "it offers " + query + ", whose cases differ in their counts of numbers, and is made for version " +
             std::to_string(plugin->version) + " of nearmiss_plugin.h, whose functions have no count";
    }
    if (offer.outputs < 0 || offer.outputs > NEARMISS_MAX_VALUES) {
      return "it counts " + std::to_string(offer.outputs) + " outputs of " + query;
    }
    if (const std::uint32_t unknown = offer.needs & ~Preconditions::known_bits; unknown != 0) {
      char bits[16];
      std::snprintf(bits, sizeof bits, "%#x", unsigned(unknown));
      return "it requires " + std::string(bits) + " for " + query + ", and there is no such bit in nearmiss_plugin.h";
    }
  }
  return {};
}

/// The convention is declared for the offer: by the name of its query or, where it concerns that, for all.
bool is_declared_for(const nearmiss_declaration& d, const Offering& o) {
  if (d.query != nullptr) return text_or_none(d.query) == o.query;
  const auto convention = convention_named(text_or_none(d.convention));
  const Query* query = find_query(o.query);
  return convention && query != nullptr && concerns(*convention, *query);
}

/// Adds what the plugin declares to the offers that it is about. Returns the error in it; empty where it has none.
std::string declare_all(const nearmiss_declaration* list, Subject& subject) {
  for (std::size_t i = 0; list[i].convention != nullptr; ++i) {
    const std::string name = text_or_none(list[i].convention), query = text_or_none(list[i].query);
    if (i == most_declarations) return "its declarations have no end";
    const auto convention = convention_named(name);
    std::string fault = "it declares '";
    fault.append(name).append("'");
    if (!convention) return fault.append(", which is none of ").append(convention_names());
    bool is_about_any = false;
    for (Offering& o : subject.offerings) {
      if (!is_declared_for(list[i], o)) continue;
      o.declare({{*convention, text_or_none(list[i].sentence)}});
      is_about_any = true;
    }
    if (is_about_any) continue;
    if (list[i].query == nullptr) return fault.append(", which has no effect on a query that it offers");
    return fault.append(" for ").append(query).append(", which it does not offer");
  }
  return {};
}

bool is_unreachable(const std::string& path) { return access(path.c_str(), R_OK) != 0 && errno == EACCES; }

/// The path by which this user can load the library. Through the descriptor of its folder, where that goes, so that it
/// finds the libraries beside it by $ORIGIN.
std::string path_to_load(const std::string& path) {
  if (!is_unreachable(path)) {
    close(wire::plugin_folder), close(wire::plugin_file);
    return path;
  }
  const std::string own = "/proc/self/fd/";
  const std::string in_folder = own + std::to_string(wire::plugin_folder) + path.substr(path.rfind('/'));
  return is_unreachable(in_folder) ? own + std::to_string(wire::plugin_file) : in_folder;
}

/// The refusal of a library that the system does not load.
std::string cannot_be_loaded(const std::string& path, const std::string& loaded, std::string why) {
  if (why.starts_with(loaded + ": ")) why.erase(0, loaded.size() + 2);
  return "it cannot be loaded: " + why + (loaded == path ? "" : "; " + advice_about_unreachable(path));
}

int host_plugin(const std::string& path) {
  begin_host();
  const std::string loaded = path_to_load(path);
  void* library = dlopen(loaded.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return send_refusal(cannot_be_loaded(path, loaded, dlerror()));
  const auto entry = reinterpret_cast<Entry>(dlsym(library, "nearmiss_plugin_entry"));
  if (entry == nullptr) return send_refusal("it is no plugin: it has no function nearmiss_plugin_entry");
  const nearmiss_plugin* plugin = entry();
  const FloatingPointModes modes = FloatingPointModes::current();
  FloatingPointModes::standard().set();
  if (const std::string fault = fault_of(plugin); !fault.empty()) return send_refusal(fault);
  std::vector<AskedFunction> functions;
  Subject subject = described_by(*plugin, modes, functions);
  if (const auto declarations = reinterpret_cast<Declarations>(dlsym(library, "nearmiss_plugin_declarations"))) {
    const nearmiss_declaration* list = declarations();
    FloatingPointModes::standard().set();
    const std::string fault =
        list == nullptr ? "nearmiss_plugin_declarations() returns none" : declare_all(list, subject);
    if (!fault.empty()) return send_refusal(fault);
  }
  return run_host(subject);
}

}  // namespace

}  // namespace nearmiss

int main(int argc, char** argv) {
  nearmiss::FloatingPointModes::standard().set();
  if (argc != 2) return 2;
  const int code = nearmiss::host_plugin(argv[1]);
  _exit(code);  // skips the library's destructors
}
