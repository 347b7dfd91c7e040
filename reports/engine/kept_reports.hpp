/// Writes the findings that FindingRetention keeps as reports, at the end of each batch.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/engine/campaign.hpp"
#include "reports/engine/counts.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/engine/variant_counts.hpp"

namespace nearmiss {

class KeptReports : public Sink {
 public:
  /// Writes a file below the run folder.
  using Write = std::function<void(const std::filesystem::path& below, const std::string& text)>;

  /// `counts` must be an earlier sink of the campaign than this one.
  KeptReports(std::filesystem::path folder, const Counts& counts, Write write);
  /// Sets the workers for second opinions. Call it before the first batch.
  void ask_with(Workers& workers) { workers_ = &workers; }
  /// Lists the reports of earlier runs in the folder.
  void list_those_on_disk();

  void take(const Examined& e) override;
  bool needs_second(const Examined& e) const override;
  void end_batch() override;

  /// All reports, in the order of their names; those of earlier runs in the folder come first.
  const std::vector<WrittenReport>& written() const { return written_; }
  /// How many findings of this run there are of each kind and variant, also those that are not kept.
  const VariantCounts& variants() const { return variants_; }
  /// The reports of this run that are no longer on the disk: others have removed them.
  std::vector<std::string> vanished() const;
  /// The number of reports of this run.
  std::size_t count() const;
  /// Headline and file of the worst finding of each query, subject and fault; empty without findings.
  std::string worst_text() const;

 private:
  /// A finding whose report is due. Its report asks other subjects, so it waits until the answers to the batch are
  /// read.
  struct Pending {
    Case question;
    const Subject* subject;
    Answer answer;
    std::string output;  ///< output of a subject that broke
  };
  void write_report(const Pending& p);
  void put_in_order(WrittenReport w);

  std::filesystem::path folder_;
  const Counts& counts_;
  Write write_;
  Workers* workers_ = nullptr;
  FindingRetention retention_;
  VariantCounts variants_;
  std::vector<Pending> pending_;
  std::vector<WrittenReport> written_;
};

}  // namespace nearmiss
