#include "reports/commands/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>

#include "corpus/files/errors.hpp"
#include "corpus/files/near_words.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/host/engines.hpp"
#include "impl/host/hosts.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

template <class T>
std::optional<T> parsed(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A whole number in one of the forms 100000, 100,000 and 1e5.
std::optional<std::uint64_t> parsed_count(const std::string& text) {
  if (const auto plain = parsed<std::uint64_t>(text)) return plain;
  if (text.find(',') != std::string::npos) {
    std::string digits;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool is_place_of_comma = (text.size() - i) % 4 == 0;
      if (is_place_of_comma != (text[i] == ',') || (i == 0 && text[i] == ',')) return std::nullopt;
      if (text[i] != ',') digits += text[i];
    }
    return parsed<std::uint64_t>(digits);
  }
  const auto number = parsed<double>(text);
  constexpr double all_whole = 0x1p53;  // below it every whole number is a double
  if (!number || !(*number >= 0 && *number <= all_whole) || *number != std::floor(*number)) return std::nullopt;
  return std::uint64_t(*number);
}

std::string high_text(std::uint64_t high) {
  return high == std::numeric_limits<std::uint64_t>::max() ? "2^64 - 1" : std::to_string(high);
}

}  // namespace

std::vector<std::string> query_names() {
  std::vector<std::string> names;
  for (const Query& q : catalogue()) names.emplace_back(q.name);
  return names;
}

CLI::Validator known_query() {
  const auto check = [](const std::string& name) {
    return find_query(name) != nullptr ? "" : unknown_query_text(name);
  };
  return CLI::Validator(check, "");
}

namespace {

/// The error for a name that is no subject's: what was added for this command may call itself otherwise.
std::string unknown_subject_text(const std::string& name) {
  std::vector<std::string> added;
  for (const Subject& s : subjects_at_hand()) {
    if (!s.command.empty() || !s.plugin.empty()) added.push_back(fmt::format("'{}'", s.name));
  }
  if (added.empty() || !close_matches(name, subject_names()).empty())
    return unknown_text("subject", name, subject_names());
  return fmt::format("unknown subject '{}'; {}", one_line(name, 60),
                     added.size() == 1 ? "what was added calls itself " + added.front()
                                       : "those that were added call themselves " + list_text(added));
}

}  // namespace

CLI::Validator known_subject() {
  const auto check = [](const std::string& name) -> std::string {
    if (is_subject(name)) return "";
    const std::string missing = how_to_install(name);
    return missing.empty() ? unknown_subject_text(name) : missing;
  };
  return CLI::Validator(check, "");
}

void Selection::declare_queries(CLI::App& app) {
  app.add_option("-q,--query", query, "Only this query; may be given several times. Default: all")
      ->type_name("QUERY")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->check(known_query());
}

namespace {

/// An option whose values are loaded while the arguments are parsed.
void add_loading(CLI::App& app, const std::string& name, const std::function<void(const std::string&)>& load,
                 const std::string& description, const std::string& type) {
  app.add_option_function<std::vector<std::string>>(
         name,
         [load](const std::vector<std::string>& all) {
           for (const std::string& one : all) load(one);
         },
         description)
      ->type_name(type)
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string_view::npos ? "" : std::string(text.substr(begin, end - begin + 1));
}

/// "SUBJECT: CONVENTION", "SUBJECT QUERY: CONVENTION"; each may go on with ": SENTENCE".
void declare_by_text(const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    throw BadInput(fmt::format("--declare {}: {}", one_line(text, 200), why));
  };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) refuse("it must be \"SUBJECT: CONVENTION\" or \"SUBJECT QUERY: CONVENTION\"");
  const std::size_t second = std::min(text.find(':', colon + 1), text.size());
  const std::string of = trimmed(text.substr(0, colon)), name = trimmed(text.substr(colon + 1, second - colon - 1));
  const std::string sentence = second < text.size() ? trimmed(text.substr(second + 1)) : "";
  const std::size_t space = std::min(of.find(' '), of.size());
  const std::string subject = of.substr(0, space), query = trimmed(of.substr(space));
  if (!is_subject(subject)) refuse(unknown_subject_text(subject));
  if (!query.empty() && find_query(query) == nullptr) refuse(unknown_query_text(query));
  const auto convention = convention_named(name);
  if (!convention)
    refuse(fmt::format("no convention is '{}'; those that exist: {}", one_line(name, 60), convention_names()));
  if (!query.empty() && !concerns(*convention, *find_query(query)))
    refuse(fmt::format("'{}' has no effect on {}", name, query));
  declare(subject, query, {*convention, sentence});
  const Subject& declaring = *find_subject(subject);
  const bool is_about_any = std::any_of(declaring.offerings.begin(), declaring.offerings.end(), [&](const Offering& o) {
    const Query* q = find_query(o.query);
    return o.offer != Offer::not_offered && q != nullptr && concerns(*convention, *q) &&
           (query.empty() || query == o.query);
  });
  if (!is_about_any) {
    refuse(query.empty() ? fmt::format("'{}' has no effect on a query that {} offers", name, subject)
                         : fmt::format("{} does not offer {}", subject, query));
  }
  for (const Query& q : catalogue()) {
    Conventions all;
    for (const Declaration& d : declaring.declared_for(q.name)) {
      if (const auto other = contradicted(d.convention, all))
        refuse(fmt::format("'{}' contradicts '{}', which {} declares for {}", name_of(d.convention), name_of(*other),
                           subject, q.name));
      all.add(d.convention);
    }
  }
}

}  // namespace

void declare_foreign_subjects(CLI::App& app, std::vector<std::string>* loaded) {
  constexpr double least = 0.001, most = 3600;
  const WorkerLimits usual;
  app.add_option_function<std::string>(
         "--patience",
         [](const std::string& text) {
           WorkerLimits limits;
           limits.case_timeout = *parsed<double>(text);
           set_worker_limits(limits);
         },
         fmt::format(
             "The time limit of a subject for one case: S seconds of processor time, and {:g} times as many seconds "
             "of wall time. A subject has at least {:g} s to start. Default: {:g}",
             usual.wall() / usual.case_timeout, WorkerLimits{.case_timeout = 0}.of_start().case_timeout,
             usual.case_timeout))
      ->type_name("S")
      ->check(number_from(least, most));
  const auto loading = [loaded](std::string (*load)(const std::string&, SameName)) {
    return [loaded, load](const std::string& one) {
      const std::string name = load(one, loaded == nullptr ? SameName::refused : SameName::numbered);
      if (loaded != nullptr) loaded->push_back(name);
    };
  };
  add_loading(app, "--plugin", loading(load_plugin),
              "Add the subject of this shared library (see docs/bring-your-own.md); may be given several times",
              "FILE");
  add_loading(app, "--command", loading(load_command),
              "Add the subject that this program is (see docs/reference/protocol.md); may be given several times",
              "COMMAND");
  add_loading(app, "--declare", declare_by_text,
              "Judge a subject by a convention that its documentation states (docs/bring-your-own.md lists them): "
              "\"SUBJECT: CONVENTION\", \"SUBJECT QUERY: CONVENTION\", each also with \": SENTENCE\"; may be given "
              "several times",
              "TEXT");
}

void Selection::declare_subjects(CLI::App& app) {
  declare_foreign_subjects(app);
  app.add_option("-s,--subject", subject, "Only this subject; may be given several times. Default: all")
      ->type_name("SUBJECT")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->check(known_subject());
}

std::vector<const Query*> Selection::queries() const {
  std::vector<const Query*> some;
  for (const Query& q : catalogue()) {
    if (query.empty() || std::find(query.begin(), query.end(), q.name) != query.end()) some.push_back(&q);
  }
  return some;
}
std::vector<const Subject*> Selection::subjects() const {
  return subjects_named(subject.empty() ? subject_names() : subject);
}

void Selection::check_offered() const {
  for (const Query* q : queries()) {
    for (const Subject* s : subjects()) {
      if (s->offering(q->name).answer != nullptr) return;
    }
  }
  const Query& q = *queries().front();
  const Subject& s = *subjects().front();
  throw BadInput(fmt::format("nothing to run: no chosen subject offers a chosen query ({} does not offer {}: {})",
                             s.name, q.name, s.offering(q.name).how));
}

void SceneOption::declare(CLI::App& app) {
  app.add_option("--scene", name,
                 "Take the cases from this scene, a name that 'nearmiss scene list' shows or a file, in place of the "
                 "generator; --cases then counts the cases of its mix")
      ->type_name("SCENE");
}

std::optional<scenes::Scene> SceneOption::load() const {
  return name.empty() ? std::nullopt : std::optional(scenes::load_scene(name));
}

void judge_by(std::optional<double> given_measure, const scenes::Scene* scene) {
  if (given_measure) {
    use_measure({{*given_measure, true}, nullptr});
  } else if (scene != nullptr) {
    use_measure({{}, scenes::limits_of(*scene)});
  }
}

std::string measure_line(std::span<const Query* const> queries, std::span<const Subject* const> subjects) {
  for (const Subject* s : subjects) {
    for (const Query* q : queries) {
      if (s->offering(q->name).answer == nullptr || s->standard_for(q->name).promised) continue;
      const SceneLimits* scene = scene_limits();
      if (scene != nullptr)
        return fmt::format(
            "all subjects but the tiers of collide are counted as wrong when proved not to meet what the scene {} "
            "requires: "
            "{}\n",
            scene->scene, requirement_text(*scene));
      return fmt::format("measure {:g}: {} counted as wrong when proved to differ by more\n", measure().error,
                         measure().for_all ? "all subjects are" : "subjects that promise nothing are");
    }
  }
  return "";
}

std::string declarations_line(std::span<const Query* const> queries, std::span<const Subject* const> subjects) {
  std::string text;
  for (const Subject* s : subjects) {
    std::vector<std::pair<std::string, std::vector<std::string_view>>> each;  // conventions, and the queries with these
    for (const Query* q : queries) {
      const std::vector<Declaration> declared = s->declared_for(q->name);
      if (declared.empty() || s->offering(q->name).answer == nullptr) continue;
      const std::string words = declarations_text(declared);
      if (each.empty() || each.back().first != words) each.push_back({words, {}});
      each.back().second.push_back(q->name);
    }
    for (const auto& [words, of] : each)
      text += fmt::format("{} declares for {}: {}\n", s->name, fmt::join(of, ", "), words);
  }
  return text;
}

void select_queries_of(const scenes::Scene& scene, Selection& selection) {
  std::vector<std::string> asked;
  for (const Query* q : scene.all_queries()) asked.emplace_back(q->name);
  for (const std::string& q : selection.query) {
    if (std::find(asked.begin(), asked.end(), q) == asked.end())
      throw BadInput(
          fmt::format("--query {}: the scene {} does not ask it; it asks {}", q, scene.name, fmt::join(asked, ", ")));
  }
  if (selection.query.empty()) selection.query = asked;
}

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    const auto value = parsed_count(text);
    if (value && *value >= low && *value <= high) return "";
    return fmt::format("'{}' is not a whole number from {} to {}", text, low, high_text(high));
  };
  return CLI::Validator(check, "");
}

CLI::Validator number_from(double low, double high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    const auto value = parsed<double>(text);
    if (value && *value >= low && *value <= high) return "";
    return fmt::format("'{}' is not a number from {} to {}", text, low, high);
  };
  return CLI::Validator(check, "");
}

CLI::Validator positive_number(double high) {
  const auto check = [high](const std::string& text) -> std::string {
    const auto value = parsed<double>(text);
    if (value && *value > 0 && *value <= high) return "";
    return fmt::format("'{}' is not a number above 0 and up to {}", text, high);
  };
  return CLI::Validator(check, "");
}

void add_whole_number(CLI::App& app, const std::string& name, std::optional<std::uint64_t>& value,
                      const std::string& description, std::uint64_t low, std::uint64_t high) {
  app.add_option_function<std::string>(
         name, [&value](const std::string& t) { value = parsed_count(t); }, description)
      ->type_name("N")
      ->check(whole_number(low, high));
}

void add_positive_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                         const std::string& description, const std::string& unit, double high) {
  app.add_option_function<std::string>(
         name, [&value](const std::string& t) { value = parsed<double>(t); }, description)
      ->type_name(unit)
      ->check(positive_number(high));
}

void add_measure(CLI::App& app, std::optional<double>& measure) {
  add_positive_number(
      app, "--measure", measure,
      fmt::format("Judge all subjects by one measure in place of their contracts: a backward error of at most E, "
                  "relative to the largest number of each kind, and normals of length 1 within E. Default: their "
                  "contracts, and {:g} for those that promise nothing",
                  Measure::usual),
      "E", 1);
}

void add_exact(CLI::App& app) {
  app.add_flag_callback(
         "--exact", [] { set_decimals_of_users(Decimals::exact); },
         "Refuse a case file with a decimal that is no number of its scalar. Otherwise it means the nearest one, and a "
         "note says how many there were")
      ->disable_flag_override();
}

void add_output_folder(CLI::App& app, std::string& folder, const std::string& description) {
  app.add_option("-o,--out", folder, description)
      ->type_name("DIR")
      ->check(
          CLI::Validator([](const std::string& t) { return t.empty() ? "the name of the folder is empty" : ""; }, ""));
}

std::uint64_t seed_or_random(std::optional<std::uint64_t> given) { return given ? *given : std::random_device{}(); }

void Amount::declare(CLI::App& app, const std::string& what, const std::string& folder) {
  constexpr std::uint64_t most_cases = 1'000'000'000'000;
  constexpr double most_seconds = 1e8;
  add_whole_number(app, "-n,--cases", cases, fmt::format("{}. Default: {}", what, default_cases), 1, most_cases);
  add_positive_number(app, "-t,--seconds", seconds, "The time to run, instead of a number of cases", "S", most_seconds);
  app.get_option("--seconds")->excludes("--cases");
  add_whole_number(app, "--seed", seed, "The seed of the generator. Default: a random one, which is printed", 0,
                   std::numeric_limits<std::uint64_t>::max());
  add_measure(app, measure);
  add_output_folder(app, out, folder + ". Default: reports/runs/TIME-SEED of the source tree");
}

std::optional<std::uint64_t> Amount::number() const {
  return seconds ? std::nullopt : std::optional(cases.value_or(default_cases));
}

std::optional<std::chrono::steady_clock::time_point> Amount::until() const {
  using Steady = std::chrono::steady_clock;
  if (!seconds) return std::nullopt;
  return Steady::now() + std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(*seconds));
}

std::filesystem::path Amount::folder(std::uint64_t chosen_seed) const {
  return out.empty() ? new_run_folder(chosen_seed) : std::filesystem::path(out);
}

}  // namespace nearmiss
