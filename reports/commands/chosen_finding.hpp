/// The finding of one file that a command turns into a text for the authors of a library.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// FILE, --for, --measure, --out, and the options of foreign subjects.
class ChosenFinding {
 public:
  struct Asked {
    Report report;
    const Subject* subject;
  };

  /// `what` is written: "the test".
  void declare(CLI::App& app, const std::string& what);
  /// Asks the chosen subject the case of the file. Throws BadInput where that cannot be done.
  Asked ask() const;
  /// Writes the text to the file of --out and prints its name, or prints the text.
  void write(const std::string& text) const;
  /// The file of --out; empty without it.
  const std::string& file() const { return out_; }

 private:
  std::string file_, for_, out_;
  std::optional<double> measure_;
};

}  // namespace nearmiss
