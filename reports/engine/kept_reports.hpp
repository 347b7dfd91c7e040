/// The findings of a campaign that are worth a report, written as soon as their batch is over.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/engine/campaign.hpp"
#include "reports/engine/counts.hpp"
#include "reports/engine/run_folder.hpp"

namespace nearmiss {

class KeptReports : public Sink {
 public:
  /// Writes a file below the run folder.
  using Write = std::function<void(const std::filesystem::path& below, const std::string& text)>;

  /// `counts` is told of every finding before this sink is. Reports that are in the folder already are listed first.
  KeptReports(std::filesystem::path folder, const Counts& counts, Write write);
  /// Who is asked for second opinions. To be called before the first batch.
  void ask_with(Workers& workers) { workers_ = &workers; }
  void list_those_on_disk();

  void take(const Examined& e) override;
  void end_batch() override;

  /// Those of earlier runs in the folder first.
  const std::vector<WrittenReport>& written() const { return written_; }
  /// How many are of this run.
  std::size_t count() const;
  /// Headline and file of the worst, one for each query, subject and fault; empty without any.
  std::string worst_text() const;

 private:
  /// A report asks other subjects, whose answers to the batch may still be wanted: so it waits.
  struct Pending {
    Case question;
    const Subject* subject;
    Answer answer;
    std::string output;  ///< of a subject that broke
  };
  void write_report(const Pending& p);

  std::filesystem::path folder_;
  const Counts& counts_;
  Write write_;
  Workers* workers_ = nullptr;
  FindingRetention retention_;
  std::vector<Pending> pending_;
  std::vector<WrittenReport> written_;
};

}  // namespace nearmiss
