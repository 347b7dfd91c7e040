/// The finding of one file that a command turns into a text for the authors of a library.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// --for, --measure, and the options of foreign subjects.
class ChosenFinding {
 public:
  struct Asked {
    Report report;
    const Subject* subject;
  };

  void declare(CLI::App& app);
  /// Asks the chosen subject the case of the file. Throws BadInput where that cannot be done.
  Asked ask(const std::string& file);

 private:
  std::string for_;
  std::optional<double> measure_;
};

}  // namespace nearmiss
