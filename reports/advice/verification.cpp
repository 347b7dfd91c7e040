#include "reports/advice/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "reports/engine/interrupt.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t verification_width = 100;

std::vector<std::string> row_of_verification(const SceneEvidence& e, const std::vector<MetRequirement>& requirements) {
  return {std::string(e.query->name),
          e.subject->name,
          none_failed(requirements) ? "holds" : "FAILED",
          three_digits(e.distance.proved),
          three_digits(e.time.proved),
          fmt::format("{} of {}", count_text(e.beyond), count_text(e.cases)),
          three_digits(rate_of(e.beyond, e.cases).high)};
}

}  // namespace

Verification::Verification(const Profile& profile, std::filesystem::path file, std::uint64_t seed, std::uint64_t cases)
    : profile_(profile),
      file_(std::move(file)),
      seed_(seed),
      cases_(cases),
      source_(scene_cases(std::make_shared<const scenes::Scene>(profile.scene))),
      dispatcher_([this] { return progress_.show(done_, cases_ * profile_.queries.size(), {}, {}), !interrupted(); }),
      internal_errors_(file_.parent_path()) {
  for (const ProfiledQuery& q : profile_.queries) subjects_.push_back(&subject_of(q, file_));
}

void Verification::ask() {
  for (std::size_t i = 0; i < subjects_.size() && !interrupted(); ++i) {
    const Query& query = *profile_.queries[i].query;
    progress_.set_activity(fmt::format("fresh cases of {}", query.name));
    SceneEvidence e = measured_evidence({subjects_[i], &query, &source_, seed_, cases_}, dispatcher_, internal_errors_,
                                        [this](std::uint64_t done) {
                                          done_ += done;
                                          progress_.show(done_, cases_ * profile_.queries.size(), {}, {});
                                          return !interrupted();
                                        });
    if (!e.is_complete()) return;
    std::vector<MetRequirement> requirements = e.requirements(source_.tolerance, std::nullopt);
    verified_.push_back({std::move(e), std::move(requirements)});
  }
}

std::uint64_t Verification::failed() const {
  return std::uint64_t(std::count_if(verified_.begin(), verified_.end(),
                                     [](const Verified& v) { return !none_failed(v.requirements); }));
}

std::string Verification::text() const {
  std::vector<std::vector<std::string>> rows{{"QUERY", "SUBJECT", "REQUIRED", "ERROR", "TIME", "BEYOND", "RATE BELOW"}};
  for (const Verified& v : verified_) rows.push_back(row_of_verification(v.evidence, v.requirements));
  std::string text = table_text(rows, "", 3) + "\n";
  for (const Verified& v : verified_) {
    for (const MetRequirement& r : v.requirements) {
      if (r.state == MetRequirement::State::failed)
        text +=
            wrapped_text(fmt::format("{} of {}: {}", v.evidence.query->name, v.evidence.subject->name, failure_text(r)),
                         "", verification_width);
    }
  }
  for (const MissingQuery& m : profile_.missing) text += fmt::format("{}: {}\n", m.query->name, m.why);
  return text + wrapped_text(
                    fmt::format("{}: {} of {} keep every requirement of the scene {} on {} with the seed {}. "
                                "Lengths in {}, times in s; times of calls are not verified.",
                                path_text(file_), verified_.size() - failed(),
                                plural_text(profile_.queries.size() + profile_.missing.size(), "query"),
                                profile_.scene.name, plural_text(cases_, "fresh case"), seed_, source_.tolerance.unit),
                    "", verification_width);
}

int Verification::exit_code() const {
  if (internal_errors_.count() > 0) return InternalError::exit_code;
  if (interrupted()) return 2;
  return failed() > 0 || !profile_.missing.empty() ? 1 : 0;
}

}  // namespace nearmiss
