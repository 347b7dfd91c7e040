/// The exact answers to a case under the conventions that a subject declares.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/subject/convention.hpp"
#include "oracles/exact/oracle.hpp"

namespace nearmiss {

/// The oracle of the case's query, with the meaning that the conventions define. Each convention is an exact change of
/// the case (its front is the other side), of the answer (its normal is turned), or of the decision (a start in contact
/// is a miss). An enclosure contains every answer that is right under the conventions: what it excludes is proved.
/// Without conventions it is the oracle itself. The case and the answer must outlive this object.
class DeclaredOracle {
 public:
  DeclaredOracle(const Case& question, const Answer& answer, Conventions declared);

  /// As the functions of Oracle with these names. Under conventions every decimal is the shortest one.
  Enclosure interval(Widening widening) const;
  Enclosure exact(AlternativeList* list = nullptr) const;
  bool may_be_on_surface(Widening widening, std::size_t number, double ulps) const;

 private:
  /// How the oracle is asked.
  struct Asked {
    bool exactly;
    Widening widening;  ///< of zeros where the case itself is asked
    bool is_still;      ///< the case itself is asked
  };
  /// The case and the answer as the catalogue means them.
  struct View {
    Case question;
    Answer answer;
    bool from_behind = false;
  };
  struct Result {
    Enclosure enclosure;
    std::vector<Alternative> right{};  ///< only where they are asked for
  };
  using Part = Layout::Part;

  bool has(Convention c) const { return declared_.has(c); }
  bool lists() const { return lists_; }
  const Part* part(Role role) const;
  View view_of(const Case& question, Answer answer, bool from_behind) const;

  Result under(const Asked& asked) const;
  Result ask(const Case& question, const Answer& answer, const Asked& asked) const;
  Result of_views(const Asked& asked) const;
  Result of_view(const View& view, const Asked& asked) const;
  Result of_sides(const Asked& asked) const;
  /// Whether the center is certainly behind the plane.
  std::optional<bool> is_behind(const Asked& asked) const;

  Result with_center(Result r, const View& view, const Asked& asked) const;
  Result until_time_one(Result r, const View& view, const Asked& asked) const;
  Result by_start(Result r, const Asked& asked) const;
  std::optional<bool> starts_in_contact(const Asked& asked) const;
  Result hit_at_start(Result r) const;
  Result open_hit_at_start() const;
  Alternative start_as_hit() const;
  std::optional<Result> where_it_leaves(const Asked& asked) const;

  Result no() const;
  /// Any answer may be right.
  Result unknown() const;
  bool compares(const Enclosure& e) const { return answer_.yes ? e.may_be_yes : e.may_be_no; }
  Result either(Result a, Result b) const;
  Result front_or_back(Result front, Result back) const;
  void keep_earliest(std::vector<Alternative>& all) const;
  bool is_earlier(const Enclosure& a, const Enclosure& b) const;
  /// The member is not compared: every value is right.
  void leave_open(Enclosure& e, const Part& p) const;
  /// The member's exact numbers less the given ones lie in `off`, and their magnitudes in `magnitude`.
  void compare(Enclosure& e, const Part& p, std::span<const Bounds> off, std::span<const Bounds> magnitude) const;

  const Case& question_;
  const Answer& answer_;
  Conventions declared_;
  std::vector<View> views_;
  mutable bool lists_ = false;
};

/// The exact decision under the conventions. Thread-safe.
bool exact_decision(const Case& question, Conventions declared);

}  // namespace nearmiss
