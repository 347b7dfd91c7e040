/// Whose turn it is: streams of cases of the generator share the time of a campaign equally.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

/// The cases of one query in one scalar for the subjects that require the same of them.
struct Stream {
  const Query* query;
  Scalar scalar;
  Preconditions required;
  std::vector<const Subject*> subjects;
  std::uint64_t next = 0;  ///< the index of its next case
  double seconds = 0;      ///< that it has taken so far
  std::size_t batch;       ///< cases to ask at once
};

class Schedule {
 public:
  /// A stream for every query, scalar and set of preconditions of a subject that offers the query. `cases` of each, or
  /// without end.
  Schedule(const std::vector<const Query*>& queries, const std::vector<const Subject*>& subjects,
           std::optional<std::uint64_t> cases, std::size_t first_batch = 32);

  /// Of the streams with cases left, the one that has taken least time; nullptr where none has.
  Stream* next();
  /// At most `most` cases: a batch of the stream, or what is left of it.
  std::size_t batch_of(const Stream& s, std::size_t most) const;
  const std::vector<Stream>& streams() const { return streams_; }

 private:
  bool is_over(const Stream& s) const { return cases_ && s.next >= *cases_; }

  std::optional<std::uint64_t> cases_;
  std::vector<Stream> streams_;
};

/// Makes the next `count` cases of the stream, fitted to what its subjects require.
void generate_next(Stream& s, std::uint64_t seed, std::size_t count, std::vector<Case>& into);

}  // namespace nearmiss
