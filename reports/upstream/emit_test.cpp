#include "reports/upstream/emit_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "corpus/files/errors.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/version.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace {

Asking asking_for(const Report& r, const Subject& subject) {
  const std::string& name = subject.name;
  if (!subject.plugin.empty()) return ask_plugin(r.question, subject);
  for (const Engine& e : engines()) {
    if (e.name == name && subject.command.empty()) return ask_engine(r.question, e);
  }
  if (subject.own) return ask_collide(r.question, subject);
  if (name.starts_with("fcl")) return ask_fcl(r.question, subject);
  if (name.starts_with("libccd")) return ask_libccd(r.question, subject);
  if (name.starts_with("bullet")) return ask_bullet(r.question, subject);
  if (name == "ode") return ask_ode(r.question, subject);
  throw BadInput(
      fmt::format("no test can be written for {}: it is neither a plugin, an engine nor a tier of collide, FCL, "
                  "libccd, Bullet or ODE",
                  name));
}

/// How the conditions are written.
struct Dialect {
  std::string_view flag, no, yes;  ///< a declaration of a flag, and its values
  std::string_view got, right;     ///< "got_yes" without "yes"; the flag of a right answer
  std::string_view absolute;
  std::string_view is_near, along, length_of;  ///< helpers
  std::string_view list_begin, list_end;       ///< around three numbers that a helper takes
};
constexpr Dialect in_c{"int", "0", "1", "got_", "got_right", "fabs", "is_near", "along", "length_of", "", ""};
constexpr Dialect in_cpp{"bool",    "false", "true",      "got_", "got_right", "std::abs",
                         "is_near", "along", "length_of", "",     ""};
constexpr Dialect in_javascript{"let",    "false", "true",     "got.", "isRight", "Math.abs",
                                "isNear", "along", "lengthOf", "[",    "]"};

const Dialect& dialect_of(Asking::Style style) {
  return style == Asking::Style::c ? in_c : style == Asking::Style::javascript ? in_javascript : in_cpp;
}

/// The helpers by the beginning of their calls.
struct Helper {
  std::string_view call, text;
};
constexpr Helper helpers_in_c[] = {
    {"is_near(", R"($start$bool is_near(const double* got, double x, double y, double z, double tolerance) {
  return $abs(got[0] - x) <= tolerance && $abs(got[1] - y) <= tolerance &&
         $abs(got[2] - z) <= tolerance;
}

)"},
    {"along(", R"($startdouble along(const double* got, double x, double y, double z) {
  return got[0] * x + got[1] * y + got[2] * z;
}

)"},
    {"length_of(", R"($startdouble length_of(const double* got) {
  return sqrt(got[0] * got[0] + got[1] * got[1] + got[2] * got[2]);
}

)"},
};
/// A vector that the answer lacks is near to none.
constexpr Helper helpers_in_javascript[] = {
    {"isNear(", R"(/** Whether each coordinate is within the tolerance of the right one. */
const isNear = (got, right, tolerance) => !!got && right.every((x, i) => Math.abs(got[i] - x) <= tolerance);
)"},
    {"along(", R"(const along = (got, direction) => (got ? direction.reduce((sum, x, i) => sum + x * got[i], 0) : NaN);
)"},
    {"lengthOf(", R"(const lengthOf = (got) => Math.hypot(...(got ?? [NaN]));
)"},
};

/// Then the answer tells which members the library gives.
bool is_decided_rightly(const Report& r) {
  return r.answer.status == Answer::Status::answered && r.answer.yes == r.truth.yes;
}

/// Writes the conditions of the right answers, and the variables that they use.
class Conditions {
 public:
  /// `compared` are those of the declared members that the right answers may have.
  Conditions(const Report& r, const Asking& asking, const RightAnswers& right, const std::vector<std::size_t>& declared,
             const std::vector<std::size_t>& compared)
      : query_(*r.question.query),
        right_(right),
        members_(declared),
        compared_(compared),
        in_c_(asking.style == Asking::Style::c),
        in_javascript_(asking.style == Asking::Style::javascript),
        may_leave_out_(in_c_ || (asking.may_leave_out && !is_decided_rightly(r))),
        write_(dialect_of(asking.style)) {}

  /// In JavaScript the answer is one object.
  std::string declarations() const {
    std::string text = decides(query_.kind) ? fmt::format("{} got_yes = {};\n", write_.flag, write_.no) : "";
    for (const std::size_t m : members_) {
      const std::size_t n = count(m);
      std::string nans = "NAN";
      for (std::size_t i = 1; i < n; ++i) nans += ", NAN";
      text +=
          n == 1 ? fmt::format("double {} = NAN;\n", name(m)) : fmt::format("double {}[] = {{{}}};\n", name(m), nans);
      if (in_c_) text += fmt::format("int {} = 0;\n", flag_of(query_.layout.parts[m].name));
    }
    return in_javascript_ ? "" : text;
  }
  /// The flag of a right answer is true where the answer matches one of them.
  std::string test() const {
    std::string text = fmt::format("{} {} = {};\n", write_.flag, write_.right, write_.no);
    for (const RightAnswer& r : right_.any)
      text += fmt::format("if ({}) {} = {};\n", matches(r), write_.right, write_.yes);
    return text + unit_test();
  }
  /// The functions that the text uses.
  std::string helpers_of(const std::string& text) const {
    const std::span<const Helper> all = in_javascript_ ? std::span<const Helper>(helpers_in_javascript) : helpers_in_c;
    const Words words{{"start", in_c_ ? "static " : ""},
                      {"bool", std::string(write_.flag)},
                      {"startdouble", in_c_ ? "static double" : "double"},
                      {"abs", std::string(write_.absolute)}};
    std::string helpers;
    for (const Helper& h : all) {
      if (text.find(h.call) != std::string::npos) helpers += filled_in(h.text, words);
    }
    return helpers;
  }
  /// Prints the answer.
  std::string print() const {
    if (in_javascript_) return "console.log(\"got:\", got);\n";
    std::string format = decides(query_.kind) ? "yes = %d" : "";
    std::string arguments = decides(query_.kind) ? ", (int)got_yes" : "";
    for (const std::size_t m : members_) {
      const std::size_t n = count(m);
      std::string numbers = "%.17g";
      for (std::size_t i = 1; i < n; ++i) numbers += ", %.17g";
      format += fmt::format("{}{} = {}", format.empty() ? "" : ", ", query_.layout.parts[m].name,
                            n == 1 ? numbers : "(" + numbers + ")");
      for (std::size_t i = 0; i < n; ++i) arguments += ", " + element(m, i);
    }
    return fmt::format("{}(\"got: {}\\n\"{}{});\n", in_c_ ? "printf" : "std::printf", format,
                       arguments.empty() ? "" : ",\n    ", arguments.empty() ? "" : arguments.substr(2));
  }
  std::string_view right() const { return write_.right; }

 private:
  std::size_t count(std::size_t member) const {
    const Layout::Part& part = query_.layout.parts[member];
    return part.end - part.begin;
  }
  std::string yes() const { return fmt::format("{}yes", write_.got); }
  std::string name(std::size_t member) const {
    const std::string& own = query_.layout.parts[member].name;
    return in_javascript_ ? fmt::format("got.{}", expression_of(own)) : variable_of(own);
  }
  std::string element(std::size_t member, std::size_t i) const {
    return count(member) == 1 ? name(member) : fmt::format("{}{}[{}]", name(member), in_javascript_ ? "?." : "", i);
  }
  std::string three(const double* values) const {
    return fmt::format("{}{}, {}, {}{}", write_.list_begin, literal(values[0]), literal(values[1]), literal(values[2]),
                       write_.list_end);
  }
  /// "gave_depth", in a C++ test "!std::isnan(got_depth)".
  std::string gives(std::size_t member) const {
    if (in_javascript_) return name(member) + " !== undefined";
    return in_c_ ? flag_of(query_.layout.parts[member].name) : fmt::format("!std::isnan({})", element(member, 0));
  }
  std::string lacks(std::size_t member) const {
    return in_javascript_ ? name(member) + " === undefined" : in_c_ ? "!" + gives(member) : gives(member).substr(1);
  }
  std::string matches(const RightAnswer& r) const {
    std::vector<std::string> all;
    if (decides(query_.kind)) all.push_back((r.yes ? "" : "!") + yes());
    for (const MemberCondition& c : r.members) {
      std::vector<std::string> own = conditions(c);
      if (may_leave_out_ && !own.empty()) {
        all.push_back(fmt::format("({} || ({}))", lacks(c.member), fmt::join(own, " && ")));
      } else {
        std::move(own.begin(), own.end(), std::back_inserter(all));
      }
    }
    return all.empty() ? "1" : fmt::format("{}", fmt::join(all, " &&\n    "));
  }
  std::vector<std::string> conditions(const MemberCondition& c) const {
    if (c.any_unit_vector) return normal_conditions(c);
    std::vector<std::string> all;
    if (c.values.size() == 3 && c.tolerance > 0) {
      return {
          fmt::format("{}({}, {}, {})", write_.is_near, name(c.member), three(c.values.data()), literal(c.tolerance))};
    }
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const std::string got = element(c.member, i), right = literal(c.values[i]);
      all.push_back(c.tolerance == 0
                        ? fmt::format("{} {} {}", got, in_javascript_ ? "===" : "==", right)
                        : fmt::format("{}({} - {}) <= {}", write_.absolute, got, right, literal(c.tolerance)));
    }
    return all;
  }
  /// "fabs(length_of(got_normal) - 1) <= 1e-6".
  std::string is_unit(std::size_t member, double tolerance) const {
    return fmt::format("{}({}({}) - 1) <= {}", write_.absolute, write_.length_of, name(member), literal(tolerance));
  }
  std::vector<std::string> normal_conditions(const MemberCondition& c) const {
    std::vector<std::string> all{is_unit(c.member, c.tolerance)};
    for (const MemberCondition::Face& f : c.faces) {
      const std::string along = fmt::format("{}({}, {})", write_.along, name(c.member), three(f.direction.data()));
      if (std::isfinite(f.low)) all.push_back(fmt::format("{} >= {}", along, literal(f.low - c.tolerance)));
      if (std::isfinite(f.high)) all.push_back(fmt::format("{} <= {}", along, literal(f.high + c.tolerance)));
    }
    return all;
  }
  std::string unit_test() const {
    std::string text;
    for (const std::size_t m : compared_) {
      if (query_.layout.parts[m].role != Role::normal || right_.unit_error == 0) continue;
      const std::string given = may_leave_out_ ? gives(m) + " && " : "";
      text += fmt::format("if ({}{}!({})) {} = {};\n", decides(query_.kind) ? yes() + " && " : "", given,
                          is_unit(m, right_.unit_error), write_.right, write_.no);
    }
    return text;
  }

  const Query& query_;
  const RightAnswers& right_;
  const std::vector<std::size_t>&members_, &compared_;
  bool in_c_, in_javascript_, may_leave_out_;
  const Dialect& write_;
};

/// The members of the answer, as indices in the layout, that the statements may set.
std::vector<std::size_t> declared_members(const Report& r, const Asking& asking) {
  const Query& query = *r.question.query;
  std::vector<std::size_t> members;
  for (std::size_t m = 0; m < query.layout.parts.size(); ++m) {
    const auto& told = asking.members;
    if (std::find(told.begin(), told.end(), query.layout.parts[m].name) != told.end()) members.push_back(m);
  }
  return members;
}

/// Those that are compared: a hit at the start may come without a normal.
std::vector<std::size_t> compared_members(const Report& r, const Asking& asking) {
  std::vector<std::size_t> members = declared_members(r, asking);
  if (!is_decided_rightly(r)) return members;
  std::erase_if(members, [&](std::size_t m) { return !r.answer.gives(r.question.query->layout.parts[m].begin); });
  return members;
}

/// A call that never returns is ended after so many seconds.
constexpr int patience = 10;
bool is_late(const Report& r) { return r.finding.verdict == Verdict::broke && r.answer.late(); }

/// Writes the parts of the file.
class Emitter {
 public:
  Emitter(const Report& r, const Asking& asking, const RightAnswers& right, const std::vector<std::size_t>& declared,
          const std::vector<std::size_t>& compared)
      : r_(r),
        asking_(asking),
        right_(right),
        in_c_(is(Asking::Style::c)),
        in_javascript_(is(Asking::Style::javascript)),
        conditions_(r, asking, right, declared, compared) {}

  std::string text() const {
    const std::string test = indented(body());
    std::string text = heading() + includes() + "\n" + helpers(test) + start() + test;
    text += in_javascript_ ? "});\n" : "}\n";
    if (is(Asking::Style::googletest_with_main)) text += std::string(main_of_tests);
    return text;
  }

 private:
  static constexpr std::string_view main_of_tests = R"(
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
)";
  bool is(Asking::Style style) const { return asking_.style == style; }
  bool googletest() const { return is(Asking::Style::googletest) || is(Asking::Style::googletest_with_main); }
  bool late() const { return is_late(r_); }
  std::string fault() const { return is_bad(r_.finding) ? fault_of(r_.finding) : "not-right"; }
  std::string paragraph(const std::string& text) const {
    return wrapped_text(in_c_comment(text), in_c_ ? " * " : "// ", 100);
  }
  std::string heading() const {
    const std::string empty = in_c_ ? " *\n" : "//\n";
    return (in_c_ ? "/*\n" : "") + paragraph(headline(r_) + ".") + empty + paragraph(explanation(r_)) +
           paragraph(allowance_text(r_, right_) + ".") + empty +
           paragraph(fmt::format("Seen with {} ({}){}. {}:", r_.version, r_.subject,
                                 asking_.packages.empty() ? "" : "; packages of Debian: " + asking_.packages,
                                 in_javascript_ ? "Run in the folder of this file" : "Build")) +
           (in_c_ ? " *   " : "//   ") + in_c_comment(asking_.build) + "\n" +
           paragraph(fmt::format("Written by Nearmiss {}.", version())) + (in_c_ ? " */\n" : "");
  }
  std::string includes() const {
    if (in_javascript_)
      return "import assert from \"node:assert/strict\";\nimport test from \"node:test\";\n" + asking_.includes;
    std::string text = asking_.includes + "\n";
    if (googletest()) text += "#include <gtest/gtest.h>\n\n";
    std::vector<std::string_view> headers{"<cmath>", "<cstdio>"};
    if (in_c_) headers = {"<math.h>", "<stdio.h>"};
    if (late()) headers.push_back("<unistd.h>");
    for (const std::string_view header : headers) {
      if (text.find(header) == std::string::npos) text += fmt::format("#include {}\n", header);
    }
    return text;
  }
  std::string helpers(const std::string& test) const {
    const std::string conditions = conditions_.helpers_of(test);
    if (in_javascript_) return asking_.helpers + conditions + "\n";
    const std::string all = conditions + asking_.helpers;
    if (all.empty()) return "";
    return in_c_ ? all + "\n" : "namespace {\n\n" + all + "\n}  // namespace\n\n";
  }
  std::string start() const {
    if (in_javascript_) return fmt::format("test(\"{}: {}\", () => {{\n", r_.question.query->name, fault());
    if (in_c_) return "int main(void) {\n";
    if (!googletest()) return "int main() {\n";
    std::string name = fmt::format("{}_{}_{}", r_.question.query->name, fault_of(r_.finding), id_of(r_));
    std::replace(name.begin(), name.end(), '-', '_');
    return fmt::format("TEST({}, {}) {{\n", asking_.suite, name);
  }
  std::string body() const {
    std::string text;
    if (late() && !in_javascript_)
      text += fmt::format("alarm({});{}\n", patience, in_c_ ? "" : "  // the library does not return");
    text += conditions_.declarations() + asking_.statements;
    const std::string truth = in_c_comment("Exactly, " + truth_text(*r_.question.query, r_.truth) + ".");
    return text + (in_c_ ? "\n/* " + truth + " */\n" : "\n// " + truth + "\n") + conditions_.test() + verdict();
  }
  std::string verdict() const {
    const std::string_view right = conditions_.right();
    if (in_javascript_) return conditions_.print() + fmt::format("assert.ok({}, \"FAILED: {}\");\n", right, fault());
    if (googletest())
      return fmt::format("if (!got_right) {}EXPECT_TRUE(got_right) << \"{}\";\n", conditions_.print(), fault());
    return conditions_.print() + fmt::format("if (!got_right) {}(\"FAILED: {}\\n\");\nreturn got_right ? 0 : 1;\n",
                                             in_c_ ? "printf" : "std::printf", fault());
  }

  const Report& r_;
  const Asking& asking_;
  const RightAnswers& right_;
  bool in_c_, in_javascript_;
  Conditions conditions_;
};

}  // namespace

namespace {

const char* extension_of(Asking::Style style) {
  return style == Asking::Style::c ? "c" : style == Asking::Style::javascript ? "mjs" : "cpp";
}

std::string source_of_bound(const Report& r) {
  if (r.scene) return fmt::format("what the scene {} tolerates, as a share of the largest length", r.scene->scene);
  if (r.standard.promised && r.standard.contract.backward < collide::Contract::none)
    return "the bound that follows from the library's documented tolerance";
  return "a measure, because the library documents no bound";
}

}  // namespace

std::string allowance_text(const Report& r, const RightAnswers& right) {
  return fmt::format(
      "An answer is accepted where it is exact for inputs that differ from these by at most {}: {}{}",
      amount_text(right.allowed, r.question.scalar), source_of_bound(r),
      right.narrowed ? ". The tolerances are narrower than that, because the numbers are wrong only together" : "");
}

EmittedTest emit_test(const Report& r, const Subject& subject, const std::string& file) {
  if (r.finding.verdict == Verdict::cannot_answer || r.finding.verdict == Verdict::not_asked)
    throw BadInput(fmt::format("{} has no answer to this case: {}", subject.name, r.finding.clause));
  Asking asking = asking_for(r, subject);
  const std::string extension = extension_of(asking.style),
                    usual = (extension == "mjs" ? "finding.test." : "test.") + extension;
  constexpr std::string_view runner = "node --test";  // of which another process runs the test
  if (const std::size_t at = asking.build.find(runner); is_late(r) && at != std::string::npos)
    asking.build.replace(at, runner.size(), fmt::format("timeout {} node", patience));
  if (extension != "mjs") asking.build += " -o finding";
  if (!file.empty()) asking.build.replace(asking.build.find(usual), usual.size(), shell_quoted(file));
  const std::vector<std::size_t> declared = declared_members(r, asking), compared = compared_members(r, asking);
  const RightAnswers right = right_answers(r.question, r.answer, r.finding, r.standard, r.truth, compared);
  if (accepts(right, *r.question.query, r.answer) == is_bad(r.finding)) {
    throw BadInput(
        fmt::format("{}: its answer is neither proved to be wrong nor one of the right answers", subject.name));
  }
  return {Emitter(r, asking, right, declared, compared).text(), extension, asking.build};
}

}  // namespace nearmiss
