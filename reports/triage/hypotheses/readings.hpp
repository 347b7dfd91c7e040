/// The closed table of alternative readings of a query: other meanings of its inputs or of its answer.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "impl/subject/convention.hpp"
#include "reports/triage/causes/tested.hpp"

namespace nearmiss {

/// Whether nothing is proved against an answer to a case.
using IsRight = std::function<bool(const Case&, const Answer&)>;

struct Reading {
  std::string_view name;  ///< "normal reversed": the key of the cause
  std::string_view what;  ///< completes "the answer is right if "
  CauseKind kind = CauseKind::convention;
  bool decides = false;  ///< it is about the decision alone
  /// Whether the answer is right under this reading; empty where the reading makes no difference to the case.
  std::optional<bool> (*right)(const Case& c, const Answer& a, const IsRight& is_right) = nullptr;
  std::optional<Convention> convention{};  ///< the one that a subject may declare with this meaning
};

std::span<const Reading> readings();
/// What is true besides where a reading is the cause. A meaning does not depend on how numbers are rounded. A decision
/// at a touch may.
std::vector<Prediction> predictions_of(const Reading& reading);
/// Those about the numbers of the answer: also those of values and of contacts.
std::span<const Reading> readings_of_answers();
/// Those about the front of a plane or triangle, or the frame of a box; they are among readings().
std::span<const Reading> readings_of_frames();
/// Those that change the inputs; they are among readings().
std::span<const Reading> readings_of_inputs();
/// Those that take a value of the answer for another one, or for that of another contact; they are among readings().
std::span<const Reading> readings_of_values();
/// Those about the place, the normal and the time of a contact, which may be of another thing; they are among
/// readings().
std::span<const Reading> readings_of_contacts();
/// The first member with this role that the answer gives; nullptr if there is none, or the answer is no.
const Layout::Part* given_part(const Case& c, const Answer& a, Role role);
/// Whether something moves and touches, or overlaps, at the start.
bool starts_in_contact(const Case& c);

}  // namespace nearmiss
