/// Schedules streams of generated cases, so that they share the time of a campaign equally.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "corpus/scenes/scene_file.hpp"
#include "impl/catalogue/case.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

/// The cases of one query in one scalar, for subjects with the same preconditions.
struct Stream {
  const Query* query;
  Scalar scalar;
  Preconditions required;
  std::vector<const Subject*> subjects;
  std::uint64_t next = 0;                ///< the index of its next case
  double seconds = 0;                    ///< time that it has taken so far
  std::size_t batch;                     ///< cases in its next batch
  std::optional<std::uint64_t> cases{};  ///< how many it has; empty: no end
  const scenes::Scene* scene = nullptr;  ///< where its cases are taken from; nullptr: the generator
  double share = 1;                      ///< its share of the time, relative to the others

  bool is_over() const { return cases && next >= *cases; }
};

class Schedule {
 public:
  /// Makes a stream for every query, scalar and set of preconditions of a subject that offers the query. Each has
  /// `cases` cases, or no end. With a scene, which must outlive the schedule, the queries are those of the scene's mix
  /// among `queries`; they share the cases, or the time, by their weights.
  Schedule(const std::vector<const Query*>& queries, const std::vector<const Subject*>& subjects,
           std::optional<std::uint64_t> cases, std::size_t first_batch = 32, const scenes::Scene* scene = nullptr);

  /// The stream that has taken the least of its share of the time, of those with cases left; nullptr where no stream
  /// has cases left.
  Stream* next();
  /// The size of the stream's next batch: at most `most`, and at most the cases left.
  std::size_t batch_of(const Stream& s, std::size_t most) const;
  const std::vector<Stream>& streams() const { return streams_; }

 private:
  std::vector<Stream> streams_;
};

/// Makes the next `count` cases of the stream, which meet the preconditions of its subjects.
void generate_next(Stream& s, std::uint64_t seed, std::size_t count, std::vector<Case>& into);

}  // namespace nearmiss
