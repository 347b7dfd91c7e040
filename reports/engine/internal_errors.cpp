#include "reports/engine/internal_errors.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/engine/progress.hpp"
#include "reports/findings/hash.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {
constexpr const char* subfolder = "internal-errors";
}

std::optional<Finding> InternalErrors::judged(const Case& question, const Subject& subject, const Answer& answer,
                                              const Standard& standard, Detail detail, const SecondLook& needs_second) {
  try {
    return confirmed(question, answer, standard, detail, needs_second);
  } catch (const InternalError& error) {
    add(subject, error);
    return std::nullopt;
  }
}

void InternalErrors::add(const Subject& subject, const InternalError& error) {
  ++count_;
  if (kept_.size() == most_kept) return;
  const Case& question = error.question();
  Fnv1a fnv;
  fnv.add(subject.name);
  fnv.add(question);
  const std::string words = fmt::format("{}: {}", subject.name, error.what());
  const std::filesystem::path below =
      std::filesystem::path(subfolder) / fmt::format("{}-{}-{}.json", question.query->name, subject.name, fnv.id());
  nlohmann::ordered_json j = case_to_json(question);
  j["note"] = words;
  make_folder(folder_ / subfolder);
  write_file(folder_ / below, pretty_json(j));
  say_on_stderr(fmt::format("nearmiss: internal error: {}; {}\n", words, path_text(folder_ / below)));
  kept_.push_back({below.generic_string(), std::string(question.query->name), subject.name, error.what()});
}

std::string InternalErrors::text() const {
  if (count_ == 0) return "";
  return fmt::format("; {}, see {}", plural_text(count_, "internal error"), path_text(folder_ / subfolder));
}

nlohmann::ordered_json InternalErrors::to_json() const {
  nlohmann::ordered_json kept = nlohmann::ordered_json::array();
  for (const Kept& k : kept_) {
    kept.push_back({{"file", k.file}, {"query", k.query}, {"subject", k.subject}, {"words", k.words}});
  }
  return {{"count", count_}, {"kept", kept}};
}

}  // namespace nearmiss
