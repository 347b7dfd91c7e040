#include "corpus/importers/nyu_ccd.hpp"
#include "impl/catalogue/query_ids.hpp"

#include <fmt/format.h>
#include <gmpxx.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

namespace nearmiss {

namespace {

using Point = std::array<mpq_class, 3>;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The number as a double, if a double can hold it.
std::optional<double> as_double(const mpq_class& q) {
  const double x = q.get_d();
  if (!std::isfinite(x) || mpq_class(x) != q) return std::nullopt;
  return x;
}

struct Row {
  Point point;
  bool truth = false;
};

/// Reads rows and counts lines.
class RowReader {
 public:
  explicit RowReader(const std::filesystem::path& file) : file_(file), in_(file) {
    if (std::filesystem::is_directory(file))
      throw BadInput(fmt::format("{}: cannot be read: it is a folder", file.string()));
    if (!in_) throw BadInput(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  }
  /// False at the end of the file.
  bool next(Row& row) {
    if (!read_line()) return false;
    parse(row);
    return true;
  }
  std::size_t number() const { return number_; }
  std::string where(std::size_t row) const { return fmt::format("{}:{}", file_.string(), row); }
  [[noreturn]] void fail(std::string_view what) const { throw BadInput(fmt::format("{}: {}", where(number_), what)); }

 private:
  static constexpr std::size_t columns = 7, most_of_a_line = std::size_t{1} << 16;

  /// Reads the next line without its line ending. False at the end of the file.
  bool read_line() {
    line_.clear();
    ++number_;
    for (int c = in_.get(); c != '\n'; c = in_.get()) {
      if (c == std::ifstream::traits_type::eof()) {
        if (in_.bad()) fail("the rest cannot be read");
        if (!line_.empty()) break;
        --number_;  // the file ends after a line ending
        return false;
      }
      line_ += char(c);
      if (c == '\0') fail("a byte is 0: this is no text, or a text in UTF-16, which must be UTF-8 here");
      if (line_.size() > most_of_a_line) fail("a line has more than 65,536 bytes");
    }
    if (number_ == 1 && (line_.starts_with("\xFF\xFE") || line_.starts_with("\xFE\xFF"))) {
      fail("this is a text in UTF-16, which must be UTF-8 here");
    }
    if (number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.erase(0, 3);  // a byte order mark of UTF-8
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    return true;
  }
  void parse(Row& row) {
    std::array<std::string, columns> cells;
    std::size_t count = 0;
    for (std::string_view rest = line_;;) {
      const std::size_t comma = rest.find(',');
      if (count == columns) fail("more than 7 columns");
      cells[count++] = rest.substr(0, comma);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    if (count != columns) fail(fmt::format("{} columns: it must be 7", count));
    for (std::size_t i = 0; i < 3; ++i) row.point[i] = ratio(integer(cells[2 * i]), integer(cells[2 * i + 1]));
    if (cells[6] != "0" && cells[6] != "1") fail(fmt::format("the truth is \"{}\": it must be 0 or 1", cells[6]));
    row.truth = cells[6] == "1";
  }
  mpz_class integer(const std::string& cell) const {
    const bool negative = cell.starts_with('-');
    const std::string_view digits = std::string_view(cell).substr(negative ? 1 : 0);
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
      fail(fmt::format("\"{}\" is not an integer", cell));
    }
    return mpz_class(cell, 10);
  }
  mpq_class ratio(const mpz_class& numerator, const mpz_class& denominator) const {
    if (denominator == 0) fail("a denominator is 0");
    mpq_class q(numerator, denominator);
    q.canonicalize();
    return q;
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  std::size_t number_ = 0;
};

/// The vertex and the face's corners at time 0, then at time 1.
using Rows = std::array<Row, 8>;

/// False at the end of the file.
bool read_query(RowReader& reader, Rows& rows) {
  if (!reader.next(rows[0])) return false;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (!reader.next(rows[i])) reader.fail(fmt::format("the file ends after {} of a query's 8 rows", i));
    if (rows[i].truth != rows[0].truth) reader.fail("the truth differs from that of the query's first row");
  }
  return true;
}

bool append(const Point& p, std::vector<double>& values) {
  for (const mpq_class& q : p) {
    const auto x = as_double(q);
    if (!x) return false;
    values.push_back(*x);
  }
  return true;
}

/// Empty if the query is not a point that moves past a fixed triangle, exactly in double.
std::optional<GroundTruth> fit(const Rows& rows) {
  const auto at = [&](std::size_t i) -> const Point& { return rows[i].point; };
  const Point moved = minus(at(5), at(1));
  if (minus(at(6), at(2)) != moved || minus(at(7), at(3)) != moved) return std::nullopt;
  const Point velocity = minus(minus(at(4), at(0)), moved);
  const mpq_class along_normal = dot(cross(minus(at(2), at(1)), minus(at(3), at(1))), velocity);
  const bool from_behind = along_normal > 0;
  GroundTruth g{{&query_of(QueryId::moving_point_triangle), Scalar::float64, {}, {}, 0, 0, {}},
                rows[0].truth,
                along_normal == 0,
                {}};
  for (const Point* p : {&at(0), &velocity, &at(1), &at(from_behind ? 3 : 2), &at(from_behind ? 2 : 3)}) {
    if (!append(*p, g.question.values)) return std::nullopt;
  }
  return g;
}

void read_into(GroundTruths& all, const std::filesystem::path& file) {
  RowReader reader(file);
  Rows rows;
  std::uint64_t index = 0;
  for (std::size_t first = 1; read_query(reader, rows); first = reader.number() + 1) {
    ++all.queries;
    if (auto g = fit(rows)) {
      g->where = reader.where(first);
      g->question.origin = g->where;
      g->question.index = index;
      all.fit.push_back(std::move(*g));
    } else {
      ++all.skipped;
    }
    ++index;
  }
}

/// A query of the sample: the face is (0,0,0), (4,0,0), (0,4,0); both vertex and face move by `carried`.
struct SampleQuery {
  std::array<double, 3> from, by, carried;
  bool collides;
};

std::string sample_row(const std::array<double, 3>& p, bool collides) {
  std::string row;
  for (double x : p) {
    const mpq_class q(x);
    row += q.get_num().get_str() + ',' + q.get_den().get_str() + ',';
  }
  return row + (collides ? "1\n" : "0\n");
}

std::array<double, 3> sum(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

constexpr SampleQuery sample[] = {
    {{1, 1, 2}, {0, 0, -4}, {0, 0, 0}, true},                    // hit: through the inside at 1/2
    {{1, 1, 2}, {0, 0, -2}, {0, 0, 0}, true},                    // touch: arrives at time 1
    {{1, 1, 2}, {0, 0, -2 + 0x1p-52}, {0, 0, 0}, false},         // one ulp short of it
    {{1, 1, 0}, {0, 0, -1}, {0, 0, 0}, true},                    // starts on the face
    {{5, 5, 2}, {0, 0, -4}, {0, 0, 0}, false},                   // miss: beside the face
    {{2, 2, 2}, {0, 0, -4}, {0, 0, 0}, true},                    // through the long edge
    {{2 + 0x1p-51, 2, 2}, {0, 0, -4}, {0, 0, 0}, false},         // one ulp beside it
    {{0, 4, 2}, {0, 0, -4}, {0, 0, 0}, true},                    // through a vertex
    {{0, 0, 2}, {0, 0, -4}, {0, 0, 0}, true},                    // through the right angle
    {{1, 1, -2}, {0, 0, 4}, {0, 0, 0}, true},                    // from behind
    {{1, 1, 2}, {0, 0, 4}, {0, 0, 0}, false},                    // moves away
    {{-2, 1, 1}, {8, 0, 0}, {0, 0, 0}, false},                   // parallel, above the face
    {{0.75, 0.5, 1}, {0.25, 0.5, -1.5}, {8, -16, 0.125}, true},  // both move
};

}  // namespace

GroundTruths read_nyu_ccd(const std::vector<std::filesystem::path>& files) {
  GroundTruths all;
  for (const auto& file : files) read_into(all, file);
  return all;
}

std::string nyu_ccd_sample() {
  constexpr std::array<double, 3> corners[] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  std::string text;
  for (const SampleQuery& q : sample) {
    text += sample_row(q.from, q.collides);
    for (const auto& c : corners) text += sample_row(c, q.collides);
    text += sample_row(sum(sum(q.from, q.by), q.carried), q.collides);
    for (const auto& c : corners) text += sample_row(sum(c, q.carried), q.collides);
  }
  return text;
}

}  // namespace nearmiss
