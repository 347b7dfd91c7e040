/// The files of commands that work on findings one by one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "reports/commands/options.hpp"

namespace nearmiss {

/// A file and the subjects that are to be asked its case.
struct Task {
  std::string file;
  std::string text;  ///< of the file
  Case question;
  Measure measure;
  std::vector<const Subject*> subjects;
};

/// Reads a case, a stored case or a report. The subjects are those of the selection or, without one, that of the
/// report. A given measure replaces that of the file. `verb` completes "and one can be": "minimised". Throws BadInput.
Task read_task(const std::string& file, const Selection& selection, std::optional<double> measure,
               const std::string& verb);

/// The task's case in the subject's scalar; empty where the subject cannot be asked it. Throws BadInput where that
/// subject is the only one of the task.
std::optional<Case> case_for(const Task& t, const Subject& subject);

}  // namespace nearmiss
