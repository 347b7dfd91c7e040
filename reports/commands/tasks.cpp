#include "reports/commands/tasks.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run.hpp"
#include "reports/engine/run_folder.hpp"

namespace nearmiss {

Task read_task(const std::string& file, const Selection& selection, std::optional<double> measure,
               const std::string& verb) {
  settle_run_of(file);
  const std::string text = read_file(file);  // once: a pipe cannot be read twice
  const nlohmann::json j = parse_json(text, file);
  if (read_relation_case(j, file))
    throw BadInput(fmt::format("{}: it has several related cases, and one can be {}", file, verb));
  const auto subject = selection.subject.empty() ? subject_of_report(j, file) : std::nullopt;
  return {file, text, case_of(j, file), measure ? SceneMeasure{{*measure, true}, nullptr} : measure_of(j, file),
          subject ? std::vector<const Subject*>{*subject} : selection.subjects()};
}

std::optional<Case> case_for(const Task& t, const Subject& subject) {
  const Offering& offering = subject.offering(t.question.query->name);
  std::optional<Case> same = in_scalar(t.question, subject.scalar);
  if (offering.answer != nullptr && same && unmet_by(*same, offering.required).empty()) return same;
  if (t.subjects.size() == 1) throw BadInput(fmt::format("{}: {} cannot be asked this case", t.file, subject.name));
  return std::nullopt;
}

void for_each_subject(const std::vector<Task>& tasks, InternalErrors& errors,
                      const std::function<void(const Task&, const Subject&)>& work) {
  for (const Task& t : tasks) {
    use_measure(t.measure);
    for (const Subject* s : t.subjects) {
      if (interrupted()) return;
      try {
        work(t, *s);
      } catch (const InternalError& e) {
        errors.add(*s, e);
      }
    }
  }
}

std::filesystem::path folder_or_usual(const std::string& given_folder, const char* usual_folder) {
  return given_folder.empty() ? runs_folder() / usual_folder : std::filesystem::path(given_folder);
}

std::filesystem::path file_for(const Report& r, const std::filesystem::path& folder) {
  return folder / r.question.query->name / fmt::format("{}-{}-{}.json", r.subject, fault_of(r.finding), id_of(r));
}

}  // namespace nearmiss
