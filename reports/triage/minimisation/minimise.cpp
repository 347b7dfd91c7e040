#include "reports/triage/minimisation/minimise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "corpus/search/float_order.hpp"
#include "corpus/search/shrink.hpp"
#include "oracles/confirmed.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/finding_kind.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/minimisation/fewer_regions.hpp"

namespace nearmiss {

namespace {

using Clock = std::chrono::steady_clock;

/// Tells whether a changed case still has the finding, by asking the subject and judging its answer.
class SameFault {
 public:
  SameFault(const Subject& subject, Workers& workers, const std::function<void(std::uint64_t)>& tick)
      : subject_(subject), workers_(workers), tick_(tick) {}

  /// Takes the finding of this case as the one to keep. False where it has none.
  bool begin(const Case& question) {
    const Answer answer = workers_.ask(subject_, question);
    for (const Detail detail : {Detail::verdict, Detail::full}) {
      detail_ = detail;
      const Finding f = judged(question, answer);
      kind_ = kind_key_of(f);
      kept_ = answer;
      if (is_bad(f)) return true;
    }
    return false;
  }
  /// From now on nothing holds after this time, and has_ended() says so.
  void give(std::chrono::duration<double> time) {
    begin_ = Clock::now(), time_ = time;
    ended_ = false;
  }
  bool has_ended() const { return ended_ || interrupted(); }
  bool holds(const Case& c) {
    ended_ = ended_ || Clock::now() - begin_ >= time_;
    if (has_ended()) return false;
    const Answer answer = workers_.ask(subject_, c);
    if (interrupted()) return false;  // the worker may have given up
    tick_(++questions_);
    if (kind_key_of(judged(c, answer)) != kind_) return false;
    kept_ = answer;
    return true;
  }
  /// The answer to the last case with the finding.
  const Answer& kept() const { return kept_; }
  std::uint64_t questions() const { return questions_; }

 private:
  Finding judged(const Case& c, const Answer& answer) const {
    return confirmed(c, answer, subject_.standard_for(c.query->name), detail_);
  }

  const Subject& subject_;
  Workers& workers_;
  const std::function<void(std::uint64_t)>& tick_;
  Detail detail_ = Detail::verdict;
  KindKey kind_;
  Answer kept_;
  std::uint64_t questions_ = 0;
  Clock::time_point begin_;
  std::chrono::duration<double> time_{};
  bool ended_ = false;
};

Case simplest(const Case& question, const MinimiseLimits& limits, SameFault& fault, Minimised::End& end) {
  fault.give(limits.time);
  const auto most = int(std::min<std::uint64_t>(limits.questions, INT_MAX));
  const auto holds = [&](const Case& c) { return fault.holds(c); };
  const Case begin = limits.stays_in_regions ? in_fewer_regions(question, holds) : question;
  const FeatureRegions regions = feature_regions_of(begin);
  const auto keeps = [&](const Case& c) {
    return (!limits.stays_in_regions || feature_regions_of(c).within(regions)) && fault.holds(c);
  };
  Case found = shrink(begin, keeps, most);
  end = interrupted()                           ? Minimised::End::interrupted
        : fault.has_ended()                     ? Minimised::End::time
        : fault.questions() >= limits.questions ? Minimised::End::questions
                                                : Minimised::End::simplest;
  return found;
}

/// Finds the range of one number. Positions are those of float_order.hpp.
class Range {
 public:
  Range(const Case& c, std::size_t number, SameFault& fault)
      : case_(c), number_(number), fault_(fault), last_(order_of(c.scalar, largest_finite(c.scalar))) {}

  SameFinding find() {
    const std::int64_t at = order_of(case_.scalar, case_.values[number_]);
    const std::int64_t low = end_of(at, -1), high = end_of(at, 1);
    return {number_, of_order(case_.scalar, low), of_order(case_.scalar, high), !is_valid(low - 1),
            !is_valid(high + 1)};
  }

 private:
  Case with(std::int64_t position) const {
    Case c = case_;
    c.values[number_] = of_order(c.scalar, position);
    return c;
  }
  bool is_valid(std::int64_t position) const {
    return -last_ <= position && position <= last_ && !case_.query->broken(with(position).values);
  }
  bool is_same(std::int64_t position) { return is_valid(position) && fault_.holds(with(position)); }

  /// The furthest position in this direction up to which every asked one has the finding.
  std::int64_t end_of(std::int64_t at, int direction) {
    const std::int64_t last = direction * last_;
    const std::uint64_t room = std::uint64_t(last_) - std::uint64_t(direction * at);
    std::int64_t same = at;
    for (std::uint64_t step = 1; same != last; step *= 2) {
      const bool beyond = step == 0 || step > room;  // 0: 2^64
      const std::int64_t next = beyond ? last : std::int64_t(std::uint64_t(at) + std::uint64_t(direction) * step);
      if (!is_same(next)) return border(same, next);
      same = next;
    }
    return same;
  }
  /// Bisects between a position with the finding and one without.
  std::int64_t border(std::int64_t same, std::int64_t other) {
    for (std::int64_t middle = std::midpoint(same, other); middle != same; middle = std::midpoint(same, other)) {
      (is_same(middle) ? same : other) = middle;
    }
    return same;
  }

  const Case& case_;
  std::size_t number_;
  SameFault& fault_;
  std::int64_t last_;
};

bool has_range(const Field& f) { return !is_discrete(f.role); }

/// The ranges of the numbers, in order, as far as the time suffices.
std::vector<SameFinding> ranges_of(const Case& c, std::chrono::duration<double> time, SameFault& fault) {
  fault.give(time);
  std::vector<SameFinding> ranges;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (!has_range(c.fields()[i])) continue;
    const SameFinding range = Range(c, i, fault).find();
    if (fault.has_ended()) break;
    ranges.push_back(range);
  }
  return ranges;
}

Minimised::RangesEnd ranges_end_of(const SameFault& fault) {
  return interrupted()       ? Minimised::RangesEnd::interrupted
         : fault.has_ended() ? Minimised::RangesEnd::time
                             : Minimised::RangesEnd::all;
}

/// An end of a range, rounded: the report has all digits.
std::string end_text(double x, bool last) { return last ? "any" : fmt::format("{:.7g}", x); }

}  // namespace

std::optional<Minimised> minimise(const Case& question, const Subject& subject, const MinimiseLimits& limits,
                                  Workers& workers, const std::function<void(std::uint64_t)>& tick) {
  SameFault fault(subject, workers, tick);
  if (!fault.begin(question) || interrupted()) return std::nullopt;
  Minimised m;
  Case found = simplest(question, limits, fault, m.end);
  const Answer answer = fault.kept();  // after an interrupt the subject cannot be asked again
  if (limits.finds_ranges) {
    m.ranges = ranges_of(found, limits.time, fault);
    m.ranges_end = ranges_end_of(fault);
  }
  if (interrupted()) m.end = Minimised::End::interrupted;
  m.questions = fault.questions();
  m.report = examine(found, subject, answer, workers);
  return m;
}

std::optional<Minimised> ranges_around(const Case& question, const Subject& subject, std::chrono::duration<double> time,
                                       Workers& workers, const std::function<void(std::uint64_t)>& tick) {
  SameFault fault(subject, workers, tick);
  if (!fault.begin(question) || interrupted()) return std::nullopt;
  Minimised m;
  m.ranges = ranges_of(question, time, fault);
  m.ranges_end = ranges_end_of(fault);
  m.questions = fault.questions();
  return m;
}

std::string_view name_of(Minimised::End end) {
  switch (end) {
    case Minimised::End::simplest: return "the lack of a simpler case";
    case Minimised::End::questions: return "the number of questions";
    case Minimised::End::time: return "the time";
    case Minimised::End::interrupted: return "an interrupt";
  }
  return "?";
}

std::string_view name_of(Minimised::RangesEnd end) {
  switch (end) {
    case Minimised::RangesEnd::all: return "all";
    case Minimised::RangesEnd::not_sought: return "not sought";
    case Minimised::RangesEnd::time: return "the time";
    case Minimised::RangesEnd::interrupted: return "an interrupt";
  }
  return "?";
}

namespace {

Minimised::RangesEnd ranges_end_in(const FileValue& words) {
  for (const auto end : {Minimised::RangesEnd::all, Minimised::RangesEnd::not_sought, Minimised::RangesEnd::time,
                         Minimised::RangesEnd::interrupted}) {
    if (words.text() == name_of(end)) return end;
  }
  words.fail("what ended the search for ranges");
}

Minimised::End end_in(const FileValue& words) {
  for (const auto end :
       {Minimised::End::simplest, Minimised::End::questions, Minimised::End::time, Minimised::End::interrupted}) {
    if (words.text() == name_of(end)) return end;
  }
  words.fail("what ended the search for a simpler case");
}

}  // namespace

nlohmann::ordered_json ranges_to_json(const std::vector<SameFinding>& ranges, const Case& question) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const SameFinding& r : ranges) {
    all.push_back({{"number", question.name(r.number)},
                   {"low", r.low},
                   {"high", r.high},
                   {"to_lowest", r.to_lowest},
                   {"to_highest", r.to_highest}});
  }
  return all;
}

nlohmann::ordered_json minimised_to_json(const Minimised& m) {
  nlohmann::ordered_json j = report_to_json(m.report);
  j["minimised"] = {{"questions", m.questions},
                    {"ended_by", name_of(m.end)},
                    {"ranges_ended_by", name_of(m.ranges_end)},
                    {"same_finding", ranges_to_json(m.ranges, m.report.question)}};
  return j;
}

Minimised minimised_from_json(const FileValue& minimised, const Report& report) {
  Minimised m;
  m.report = report;
  m.questions = minimised.at("questions").count();
  m.end = end_in(minimised.at("ended_by"));
  const std::span<const Field> inputs = report.question.fields();
  for (const FileValue& range : minimised.at("same_finding").items()) {
    const std::string name = range.at("number").text();
    const auto field = std::find_if(inputs.begin(), inputs.end(), [&](const Field& f) { return name == f.name; });
    if (field == inputs.end()) continue;
    m.ranges.push_back({std::size_t(field - inputs.begin()), range.at("low").number(), range.at("high").number(),
                        range.at("to_lowest").flag(), range.at("to_highest").flag()});
  }
  // Files of earlier versions do not say.
  const bool has_all = m.ranges.size() == std::size_t(std::count_if(inputs.begin(), inputs.end(), has_range));
  if (has_all) m.ranges_end = Minimised::RangesEnd::all;
  if (const auto words = minimised.find("ranges_ended_by")) m.ranges_end = ranges_end_in(*words);
  return m;
}

std::string ranges_text(const Minimised& m) {
  const Case& c = m.report.question;
  std::vector<std::vector<std::string>> rows{{"NUMBER", "VALUE", "SAME FINDING FROM", "TO"}};
  std::string free;
  for (const SameFinding& r : m.ranges) {
    const std::string& name = c.name(r.number);
    if (r.plays_no_part()) {
      free += (free.empty() ? "" : ", ") + name;
      continue;
    }
    rows.push_back({name, number_text(c.values[r.number], c.scalar), end_text(r.low, r.to_lowest),
                    end_text(r.high, r.to_highest)});
  }
  std::string text = "What matters\n";
  if (rows.size() > 1) text += table_text(rows, "  ", 1);
  if (!free.empty())
    text += wrapped_text(
        "The finding is the same with every asked value, from the lowest valid one to the highest: " + free + ".",
        "  ");
  if (!m.ranges.empty()) {
    text += wrapped_text(
        "The subject was asked with values of each number while the others stayed: both ends of a range, and values "
        "within it at distances that double.",
        "  ");
  }
  switch (m.ranges_end) {
    case Minimised::RangesEnd::all: return text;
    case Minimised::RangesEnd::time: return text + "  The other numbers were not moved: the time was over.\n";
    case Minimised::RangesEnd::interrupted: return text + "  The other numbers were not moved: interrupted.\n";
    case Minimised::RangesEnd::not_sought: break;
  }
  return text + fmt::format("  {} not moved; 'nearmiss minimise' moves each.\n",
                            m.ranges.empty() ? "The numbers were" : "The other numbers were");
}

}  // namespace nearmiss
