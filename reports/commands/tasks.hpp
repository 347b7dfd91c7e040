/// The files of commands that work on findings one by one, and what these commands share.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "impl/catalogue/case.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
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

/// A command that works on the finding of each file and subject, and keeps a report of each.
class FindingsCommand : public Command {
 public:
  int run(const CLI::App&) override;

 protected:
  /// `verb`: as of read_task(), and the name of the usual folder.
  explicit FindingsCommand(const char* verb) : verb_(verb) {}

  /// Declares FILE, the options of subjects and measures, and --questions, --seconds, --out and --json with these
  /// texts.
  void declare_work(CLI::App& app, const char* questions, const char* seconds, const char* json);
  std::chrono::duration<double> time_or(std::chrono::duration<double> usual) const {
    return seconds_ ? std::chrono::duration<double>(*seconds_) : usual;
  }

  /// Works on one question; says nothing where it is interrupted.
  virtual void work_on(const Task& t, const Case& question, const Subject& subject) = 0;
  void say_no_finding(const Task& t, const Subject& subject) const;
  /// Names FOLDER/QUERY/SUBJECT-FAULT-ID.json, where the report is to be kept, in its command to replay it.
  std::filesystem::path file_for(Report& r, const Subject& subject) const;
  /// Writes a report to its file, and says it: as JSON, or `text`, after an empty line between pages.
  void keep(const std::filesystem::path& file, nlohmann::ordered_json report, const std::function<std::string()>& text);

  std::optional<std::uint64_t> questions_;
  Workers workers_{[] { return !interrupted(); }};
  Progress progress_;

 private:
  const char* verb_;
  std::vector<std::string> files_;
  Selection selection_;
  std::optional<double> measure_, seconds_;
  std::string out_;
  std::filesystem::path folder_;
  bool json_ = false;
  nlohmann::ordered_json reports_ = nlohmann::ordered_json::array();
  std::uint64_t found_ = 0;
};

}  // namespace nearmiss
