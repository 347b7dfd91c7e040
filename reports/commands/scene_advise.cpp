#include "reports/commands/scene_advise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "corpus/files/errors.hpp"
#include "reports/advice/profile.hpp"
#include "reports/advice/verification.hpp"
#include "reports/commands/command.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

constexpr std::uint64_t usual_cases = 10'000, most_advice_cases = 1'000'000'000;

/// The chosen subjects or, without a choice, the tiers of collide.
std::vector<const Subject*> advised_subjects(const Selection& selection) {
  if (!selection.subject.empty()) return selection.subjects();
  std::vector<std::string> own;
  for (const std::string& name : subject_names()) {
    if (!tier_of(name).tier.empty()) own.push_back(name);
  }
  return subjects_named(own);
}

void check_some_offer(const scenes::Scene& scene, const std::vector<const Subject*>& subjects) {
  for (const Query* q : scene.all_queries()) {
    for (const Subject* s : subjects) {
      if (!(s->offering(q->name).answer == nullptr)) return;
    }
  }
  throw BadInput(fmt::format("nothing to advise: none of the subjects offers a query of the scene {}", scene.name));
}

}  // namespace

void AdviseOptions::declare(CLI::App& app) {
  selection.declare_subjects(app);
  add_whole_number(app, "-n,--cases", cases,
                   fmt::format("advise, verify: fresh cases of each query. Default: {}", usual_cases), 1,
                   most_advice_cases);
  add_whole_number(app, "--seed", seed, "advise: the seed of the cases, default 1; verify: default a random one", 0,
                   std::numeric_limits<std::uint64_t>::max() - 1);
  add_output_folder(app, out, "advise: the folder. Default: reports/runs/TIME-SEED of the source tree");
}

std::string AdviseOptions::given() const {
  if (!selection.subject.empty()) return "--subject";
  if (cases) return "--cases";
  if (seed) return "--seed";
  return out.empty() ? "" : "--out";
}

int advise_scene(const std::string& name, const AdviseOptions& options) {
  const auto scene = std::make_shared<const scenes::Scene>(scenes::load_scene(name));
  const std::vector<const Subject*> chosen = advised_subjects(options.selection);
  check_some_offer(*scene, chosen);
  const std::uint64_t seed = options.seed.value_or(1);
  const std::filesystem::path folder = options.out.empty() ? new_run_folder(seed) : std::filesystem::path(options.out);
  catch_interrupts();
  Advice advice({typed_command_line(), folder, scene_cases(scene), scene->all_queries(), chosen, seed,
                 options.cases.value_or(usual_cases)});
  advice.find();
  advice.write();
  say("{}\n", advice.text());
  if (interrupted()) {
    say_on_stderr("nearmiss: interrupted: the advice lacks queries, and no profile is written\n");
    return advice.exit_code();
  }
  write_profile(profile_of(advice, *scene), advice);
  say("\nprofile: {}\n", path_text(folder / "profile.json"));
  return advice.exit_code();
}

int verify_profile(const std::string& file, const AdviseOptions& options) {
  if (!options.selection.subject.empty()) throw BadInput("--subject: scene verify asks the subjects of the profile");
  if (!options.out.empty()) throw BadInput("--out: scene verify writes no file");
  const Profile profile = load_profile(file);
  const std::uint64_t seed = seed_or_random(options.seed);
  if (seed == profile.seed)
    throw BadInput(fmt::format("--seed {}: the evidence of {} has this seed; its cases are not fresh", seed, file));
  catch_interrupts();
  Verification verification(profile, file, seed, options.cases.value_or(usual_cases));
  verification.ask();
  say("{}\n", verification.text());
  if (interrupted()) say_on_stderr("nearmiss: interrupted: the verification lacks queries\n");
  return verification.exit_code();
}

}  // namespace nearmiss
