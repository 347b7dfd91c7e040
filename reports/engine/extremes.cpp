#include "reports/engine/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "corpus/files/errors.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/html.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

/// Promises nothing, so that every answer is measured.
constexpr collide::Contract no_promise{};

void count(ExtremesCell& cell, const Finding& f) {
  if (f.verdict == Verdict::broke) ++cell.broke;
  if (f.verdict == Verdict::cannot_answer) ++cell.no_answer;
  if (f.verdict == Verdict::not_asked) ++cell.not_asked;
  if (f.verdict == Verdict::broke || f.verdict == Verdict::cannot_answer || f.verdict == Verdict::not_asked) return;
  ++cell.cases;
  cell.false_hits += f.has(Disagreement::false_hit);
  cell.false_misses += f.has(Disagreement::false_miss);
  cell.not_finite += f.has(Disagreement::not_finite);
  if (std::isfinite(f.forward_ulps)) cell.forward_ulps = std::max(cell.forward_ulps, f.forward_ulps);
  if (f.backward) cell.backward_epsilon = std::max(cell.backward_epsilon, f.backward->above);
}

template <class Member>
Json matrix(const ExtremesMap& m, Member member) {
  const std::size_t columns = m.plane.x.values.size();
  Json rows = Json::array();
  for (std::size_t i = 0; i < m.cells.size(); i += columns) {
    Json row = Json::array();
    for (std::size_t k = i; k < i + columns; ++k) row.push_back(member(m.cells[k]));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json axis_to_json(const MapAxis& axis) { return {{"axis", axis.name}, {"unit", axis.unit}, {"values", axis.values}}; }

Json map_to_json(const ExtremesMap& m) {
  return {{"query", m.query->name},
          {"subject", m.subject->name},
          {"scalar", name_of(m.subject->scalar)},
          {"x", axis_to_json(m.plane.x)},
          {"y", axis_to_json(m.plane.y)},
          {"cases", matrix(m, [](const ExtremesCell& c) { return c.cases; })},
          {"false_hits", matrix(m, [](const ExtremesCell& c) { return c.false_hits; })},
          {"false_misses", matrix(m, [](const ExtremesCell& c) { return c.false_misses; })},
          {"not_finite", matrix(m, [](const ExtremesCell& c) { return c.not_finite; })},
          {"broke", matrix(m, [](const ExtremesCell& c) { return c.broke; })},
          {"no_answer", matrix(m, [](const ExtremesCell& c) { return c.no_answer; })},
          {"not_asked", matrix(m, [](const ExtremesCell& c) { return c.not_asked; })},
          {"gave_up", matrix(m, [](const ExtremesCell& c) { return c.gave_up; })},
          {"forward_ulps", matrix(m, [](const ExtremesCell& c) { return c.forward_ulps; })},
          {"backward_epsilon", matrix(m, [](const ExtremesCell& c) {
             return c.backward_epsilon < 0 ? Json(nullptr) : Json(c.backward_epsilon);
           })}};
}

bool begun(const ExtremesMap& m) {
  return std::any_of(m.cells.begin(), m.cells.end(), [](const ExtremesCell& c) {
    return c.cases + c.broke + c.no_answer + c.not_asked + c.gave_up > 0;
  });
}

/// The report as JSON text. Bytes that are not UTF-8, for example in an argument, become U+FFFD.
std::string text_of(const Json& report) { return report.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

/// Counts the findings of one cell in the map of each subject.
class Extremes::Place : public Sink {
 public:
  void at(const std::vector<ExtremesMap*>& maps, std::size_t cell) { maps_ = maps, cell_ = cell; }
  void take(const Examined& e) override {
    ExtremesMap& m =
        **std::find_if(maps_.begin(), maps_.end(), [&](const ExtremesMap* o) { return o->subject == &e.subject; });
    m.time_outs += e.answer.late();
    m.time_outs_in_row += e.answer.late();
    m.answered += e.answer.status == Answer::Status::answered;
    m.broke += e.answer.status == Answer::Status::broke;
    count(m.cells[cell_], e.finding);
  }

 private:
  std::vector<ExtremesMap*> maps_;
  std::size_t cell_ = 0;
};

namespace {

Standard nothing_promised(const Subject& subject, const Query& query) {
  const Standard standard = subject.standard_for(query.name);
  return {no_promise, true, standard.required, standard.declared};
}

/// The cell whose values are nearest to 0: no offset from the origin, and a scale of 2^0. All values of a scene are
/// ordinary.
std::size_t ordinary_cell(const MapPlane& plane) {
  const auto nearest = [](const MapAxis& axis) {
    return std::size_t(std::ranges::min_element(axis.values, {}, [](double x) { return std::abs(x); }) -
                       axis.values.begin());
  };
  return nearest(plane.y) * plane.x.values.size() + nearest(plane.x);
}

}  // namespace

Extremes::~Extremes() = default;

Extremes::Extremes(ExtremesSettings settings)
    : settings_(std::move(settings)),
      place_(std::make_unique<Place>()),
      campaign_({settings_.folder, [this] { progress_.show(done_, total_, std::nullopt, 0); }, nothing_promised,
                 Dispatcher::GiveUp::never},
                {place_.get()}) {
  make_writable_folder(settings_.folder);
  for (const Query* q : settings_.queries) {
    const std::vector<MapPlane> planes = settings_.source->planes_of(*q);
    for (std::size_t p = 0; p < planes.size(); ++p) {
      for (const Subject* s : settings_.subjects) {
        if (s->offering(q->name).answer == nullptr) continue;
        const std::size_t cells = planes[p].x.values.size() * planes[p].y.values.size();
        maps_.push_back({q, s, planes[p], p, std::vector<ExtremesCell>(cells)});
        total_ += cells * settings_.cases;
      }
    }
  }
}

void Extremes::fill() {
  for (const Query* q : settings_.queries) {
    const std::vector<MapPlane> planes = settings_.source->planes_of(*q);
    for (std::size_t p = 0; p < planes.size(); ++p) {
      for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
        progress_.set_activity(fmt::format("{}, {} and {}", q->name, planes[p].x.name, planes[p].y.name));
        fill(*q, scalar, p);
        if (interrupted()) return;
      }
    }
  }
}

void Extremes::fill(const Query& query, Scalar scalar, std::size_t plane) {
  std::vector<ExtremesMap*> asked;
  for (ExtremesMap& m : maps_) {
    if (m.query == &query && m.subject->scalar == scalar && m.number_of_plane == plane) asked.push_back(&m);
  }
  if (asked.empty()) return;
  const std::size_t columns = asked.front()->plane.x.values.size();
  const MapCases::Cells cases_of = settings_.source->cells(query, plane, scalar, settings_.seed, settings_.cases);
  for (std::size_t cell = 0; cell < asked.front()->cells.size() && !interrupted(); ++cell) {
    if (cell % columns == 0) {
      for (ExtremesMap* m : asked) m->time_outs_in_row = 0;
    }
    const std::vector<Case> cases = cases_of(cell);
    // Small batches: a subject that times out does so in most cases of a cell.
    constexpr std::size_t most = ExtremesMap::most_in_row;
    for (std::size_t at = 0; at < cases.size() && !interrupted(); at += most) {
      ask(asked, cell, std::span(cases).subspan(at, std::min(most, cases.size() - at)));
      for (ExtremesMap* m : asked) {
        if (m->answered == 0 && m->broke >= ExtremesMap::most_broken && !m->always_breaks)
          look_whether_it_always_breaks(*m, cases_of(ordinary_cell(m->plane)));
      }
    }
    done_ += asked.size() * settings_.cases;
    progress_.show(done_, total_, std::nullopt, 0);
  }
}

void Extremes::ask(const std::vector<ExtremesMap*>& maps, std::size_t cell, std::span<const Case> cases) {
  std::vector<const Subject*> asked;
  for (ExtremesMap* m : maps) {
    if (m->given_up()) {
      m->cells[cell].gave_up += cases.size();
    } else {
      asked.push_back(m->subject);
    }
  }
  asked_ += asked.size() * cases.size();
  place_->at(maps, cell);
  campaign_.examine(asked, cases);
}

void Extremes::look_whether_it_always_breaks(ExtremesMap& m, std::span<const Case> ordinary) {
  m.broke = 0;  // where it does not, it is looked again after as many breakages
  if (ordinary.empty()) return;
  const auto breaks = [&](const Case& c) {
    return campaign_.dispatcher().workers().ask(*m.subject, c).status == Answer::Status::broke;
  };
  m.always_breaks = std::ranges::all_of(
      ordinary.first(std::min<std::size_t>(ordinary.size(), Dispatcher::least_broken_of_query)), breaks);
}

nlohmann::ordered_json Extremes::to_json() const {
  Json j{{"schema", 1},
         {"state", interrupted() ? "interrupted" : "finished"},
         {"command", settings_.command},
         {"seed", settings_.seed},
         {"cases_per_cell", settings_.cases},
         {"scene", settings_.scene},
         {"maps", Json::array()}};
  for (const ExtremesMap& m : maps_) {
    if (begun(m) || !interrupted()) j["maps"].push_back(map_to_json(m));
  }
  if (campaign_.internal_errors().count() > 0) j["internal_errors"] = campaign_.internal_errors().to_json();
  j["environment"] = environment_to_json();
  return j;
}

std::optional<std::string> Extremes::page(const nlohmann::ordered_json& report) {
#ifdef NEARMISS_D3_FILE
  std::string page = read_file(source_folder() + "/reports/extremes.html");
  put_in_page(page, "/*LIBRARY*/", in_html_script(read_file(NEARMISS_D3_FILE)));
  put_in_page(page, "/*DATA*/", in_html_script(text_of(report)));
  return page;
#else
  (void)report;
  return std::nullopt;
#endif
}

void Extremes::write() const {
  const Json report = to_json();
  write_file(settings_.folder / "extremes.json", text_of(report) + "\n");
  if (const auto drawn = page(report)) write_file(settings_.folder / "extremes.html", *drawn);
}

std::string Extremes::table() const {
  std::vector<std::vector<std::string>> rows{{"", "CASES", "FALSE HIT", "FALSE MISS", "NOT FINITE", "BROKE", "GAVE UP",
                                              "NO ANSWER", "NOT ASKED", "BACKWARD", "FORWARD"}};
  for (const Query* q : settings_.queries) {
    bool first = true;
    for (const Subject* s : settings_.subjects) {
      ExtremesCell all;
      bool any = false;
      for (const ExtremesMap& m : maps_) {
        if (m.query != q || m.subject != s) continue;
        any = true;
        for (const ExtremesCell& c : m.cells) {
          all.cases += c.cases, all.false_hits += c.false_hits, all.false_misses += c.false_misses;
          all.not_finite += c.not_finite, all.broke += c.broke, all.no_answer += c.no_answer;
          all.gave_up += c.gave_up, all.not_asked += c.not_asked;
          all.forward_ulps = std::max(all.forward_ulps, c.forward_ulps);
          all.backward_epsilon = std::max(all.backward_epsilon, c.backward_epsilon);
        }
      }
      if (!any) continue;
      if (std::exchange(first, false)) rows.push_back({std::string(q->name)});
      rows.push_back({"  " + s->name, count_text(all.cases), count_text(all.false_hits), count_text(all.false_misses),
                      count_text(all.not_finite), count_text(all.broke), count_text(all.gave_up),
                      count_text(all.no_answer), count_text(all.not_asked),
                      all.backward_epsilon < 0 ? "-" : "> " + epsilons_text(all.backward_epsilon),
                      fmt::format("{:.3g}", all.forward_ulps)});
    }
  }
  return table_text(rows, "", 1);
}

std::string Extremes::summary() const {
  const bool drawn = std::filesystem::exists(settings_.folder / "extremes.html");
  const auto maps = std::uint64_t(std::count_if(maps_.begin(), maps_.end(), begun));
  std::uint64_t gave_up = 0;
  for (const ExtremesMap& m : maps_) {
    for (const ExtremesCell& c : m.cells) gave_up += c.gave_up;
  }
  return fmt::format("{}{}, {} asked, {} given up after time-outs or breakages; {}{}{}",
                     interrupted() ? "interrupted: " : "", plural_text(maps, "map"), plural_text(asked_, "case"),
                     count_text(gave_up), path_text(settings_.folder / "extremes.json"),
                     drawn ? " and extremes.html" : "; no page, for this build found no node-d3",
                     campaign_.internal_errors().text());
}

int Extremes::exit_code() const {
  return campaign_.internal_errors().count() > 0 ? InternalError::exit_code : interrupted() ? 2 : 0;
}

}  // namespace nearmiss
