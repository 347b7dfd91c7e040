#include "reports/page/night_triage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/engine/progress.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/workers.hpp"
#include "reports/page/page.hpp"
#include "reports/page/page_data.hpp"
#include "reports/triage/comparison/baseline.hpp"
#include "reports/triage/triage_json.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using NightClock = std::chrono::steady_clock;

/// The share of the time for the plots of the page.
constexpr double plots_share = 0.2;

fs::path triage_file(const fs::path& folder) { return folder / "triage" / "triage.json"; }

}  // namespace

NightTriage::NightTriage(const Settings& settings) : folder_(settings.folder) {
  Workers workers([] { return !interrupted(); });
  Progress progress;
  const TriageSettings how{folder_ / "triage", settings.time * (1 - plots_share),
                           [&](const std::string& what, std::uint64_t done, std::uint64_t of) {
                             progress.set_activity(what);
                             progress.show(done, of, std::nullopt, std::nullopt);
                           }};
  const Sources sources = read_sources({folder_.string()});
  name_skipped(sources);
  triage_ = triage(sources, how, workers);
  for (TriagedSignature& s : triage_.signatures) s.change = SignatureChange::fresh;
  if (settings.before && !interrupted()) compare(settings, how, workers);
  make_folder(how.folder);
  write_file(triage_file(folder_), pretty_json(triage_to_json(triage_)));
  write_page(settings, workers);
}

void NightTriage::compare(const Settings& settings, const TriageSettings& how, Workers& workers) {
  try {
    const Baseline before = read_baseline(settings.before->string(), how, workers);
    for (const std::string& subject : compare_with(before, triage_, how, workers)) {
      say_on_stderr(fmt::format("nearmiss: {}: findings of {} are left out, which cannot be asked here\n",
                                settings.before->string(), subject));
    }
    compared_ = true;
  } catch (const BadInput& e) {
    say_on_stderr(fmt::format("nearmiss: {}; the night is compared with no other\n", e.what()));
  }
}

void NightTriage::write_page(const Settings& settings, Workers& workers) {
  try {
    check_page_can_be_written();
    PageData data(folder_, fs::absolute(folder_));
    const NightClock::time_point until =
        NightClock::now() + std::chrono::duration_cast<NightClock::duration>(settings.time * plots_share);
    Progress progress;
    progress.set_activity("drawing");
    data.add_reports(
        most_page_data, workers, [&] { return !interrupted() && NightClock::now() < until; },
        [&](std::size_t done) {
          progress.show(done, data.signatures(), std::nullopt, std::nullopt);
          return !interrupted();
        });
    write_file(folder_ / "index.html", page_with(data.to_json()));
    internal_errors_ = data.internal_errors();
  } catch (const BadInput& e) {
    no_page_ = e.what();
  }
}

std::size_t NightTriage::count(bool ours, SignatureChange change) const {
  return std::size_t(std::count_if(triage_.signatures.begin(), triage_.signatures.end(), [&](const auto& s) {
    return is_ours(s.kind.subject) == ours && s.change == change;
  }));
}

bool NightTriage::is_regression() const {
  return std::any_of(triage_.signatures.begin(), triage_.signatures.end(),
                     [](const auto& s) { return is_ours(s.kind.subject) && s.stands(); });
}

std::string NightTriage::counts_text(bool ours) const {
  std::vector<std::string> parts;
  for (const SignatureChange c : all_signature_changes)
    parts.push_back(fmt::format("{} {}", count(ours, c), name_of(c)));
  return fmt::format("{}{}", fmt::join(parts, ", "), changed_text(ours));
}

std::string NightTriage::changed_text(bool ours) const {
  constexpr std::size_t most = 6, most_bytes = 150;
  std::string text;
  std::size_t seen = 0;
  for (const TriagedSignature& s : triage_.signatures) {
    if (is_ours(s.kind.subject) != ours || !s.stands() || ++seen > most) continue;
    text += fmt::format("\n  {}: {}", name_of(*s.change), first_words(s.headline, most_bytes));
    if (ours) text += fmt::format("\n    {}", s.worst);
  }
  return seen > most ? fmt::format("{}\n  and {} more", text, seen - most) : text;
}

std::string NightTriage::text() const {
  const std::string page = no_page_.empty() ? path_text(folder_ / "index.html") : "none: " + no_page_;
  return fmt::format("{}: {}\nother libraries: {}\n{}page: {}", names_of_ours(), counts_text(true), counts_text(false),
                     compared_ ? "" : "no earlier night to compare with\n", page);
}

Json NightTriage::to_json() const {
  Json j{{"file", triage_file(folder_).lexically_relative(folder_).generic_string()},
         {"page", no_page_.empty() ? Json("index.html") : Json(nullptr)},
         {"compared", compared_},
         {"all_examined", triage_.all_examined}};
  for (const bool ours : {true, false}) {
    Json& side = j[ours ? "ours" : "others"] = Json::object();
    for (const SignatureChange c : all_signature_changes) side[std::string(name_of(c))] = count(ours, c);
  }
  return j;
}

std::optional<fs::path> last_triage(const fs::path& folder, const std::optional<fs::path>& siblings) {
  std::error_code error;
  if (fs::is_regular_file(triage_file(folder), error)) return triage_file(folder);
  std::optional<fs::path> newest;
  if (!siblings) return newest;
  for (const auto& entry : fs::directory_iterator(*siblings, error)) {
    const fs::path file = triage_file(entry.path());
    if (entry.path() != folder && fs::is_regular_file(file, error) && (!newest || file > *newest)) newest = file;
  }
  return newest;
}

}  // namespace nearmiss
