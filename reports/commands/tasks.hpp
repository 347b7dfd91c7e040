/// The files of commands that work on findings one by one.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/findings/report.hpp"

namespace nearmiss {

/// A file and the subjects that are to be asked its case.
struct Task {
  std::string file;
  std::string text;  ///< of the file
  Case question;
  SceneMeasure measure;
  std::vector<const Subject*> subjects;
};

/// Reads a case, a stored case or a report. The subjects are those of the selection or, without one, that of the
/// report. A given measure replaces that of the file. `verb` completes "and one can be": "minimised". Throws BadInput.
Task read_task(const std::string& file, const Selection& selection, std::optional<double> measure,
               const std::string& verb);

/// The task's case in the subject's scalar; empty where the subject cannot be asked it. Throws BadInput where that
/// subject is the only one of the task.
std::optional<Case> case_for(const Task& t, const Subject& subject);

/// Calls `work` with each task and each of its subjects, judged by the measure of the task, until an interrupt. An
/// internal error ends the work for its subject alone, and is added to `errors`.
void for_each_subject(const std::vector<Task>& tasks, InternalErrors& errors,
                      const std::function<void(const Task&, const Subject&)>& work);

/// The given folder or, without one, that of this name below the folder of runs.
std::filesystem::path folder_or_usual(const std::string& given_folder, const char* usual_folder);

/// Where such a command keeps a report: FOLDER/QUERY/SUBJECT-FAULT-ID.json.
std::filesystem::path file_for(const Report& r, const std::filesystem::path& folder);

}  // namespace nearmiss
