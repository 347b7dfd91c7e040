#include "reports/upstream/emit_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

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
  if (subject.own) return ask_collide(r.question, subject);
  if (name.starts_with("fcl")) return ask_fcl(r.question, subject);
  if (name.starts_with("libccd")) return ask_libccd(r.question, subject);
  if (name.starts_with("bullet")) return ask_bullet(r.question, subject);
  if (name == "ode") return ask_ode(r.question, subject);
  throw BadInput(fmt::format(
      "no test can be written for {}: it is neither a plugin nor a tier of collide, FCL, libccd, Bullet or ODE", name));
}

/// Writes the conditions of the right answers, and the variables that they use.
class Conditions {
 public:
  /// `compared` are those of the declared members that the right answers may have.
  Conditions(const Report& r, const RightAnswers& right, const std::vector<std::size_t>& declared,
             const std::vector<std::size_t>& compared, bool in_c)
      : query_(*r.question.query), right_(right), members_(declared), compared_(compared), in_c_(in_c) {}

  std::string declarations() const {
    std::string text;
    for (const std::size_t m : members_) {
      const std::size_t n = count(m);
      std::string nans = "NAN";
      for (std::size_t i = 1; i < n; ++i) nans += ", NAN";
      text +=
          n == 1 ? fmt::format("double {} = NAN;\n", name(m)) : fmt::format("double {}[] = {{{}}};\n", name(m), nans);
      if (in_c_) text += fmt::format("int {} = 0;\n", flag_of(query_.layout.parts[m].name));
    }
    return text;
  }
  /// `got_right` is true where the answer matches one of the right ones.
  std::string test() const {
    std::string text = in_c_ ? "int got_right = 0;\n" : "bool got_right = false;\n";
    for (const RightAnswer& r : right_.any)
      text += fmt::format("if ({}) got_right = {};\n", matches(r), in_c_ ? "1" : "true");
    return text + unit_test();
  }
  /// The functions that the text uses.
  static std::string helpers_of(const std::string& text, bool in_c) {
    const std::string start = in_c ? "static " : "", yes_or_no = in_c ? "int" : "bool",
                      abs = in_c ? "fabs" : "std::abs";
    std::string helpers;
    if (text.find("is_near(") != std::string::npos) {
      helpers += start + yes_or_no +
                 " is_near(const double* got, double x, double y, double z, double tolerance) {\n"
                 "  return " +
                 abs + "(got[0] - x) <= tolerance && " + abs +
                 "(got[1] - y) <= tolerance &&\n"
                 "         " +
                 abs + "(got[2] - z) <= tolerance;\n}\n\n";
    }
    if (text.find("along(") != std::string::npos) {
      helpers += start +
                 "double along(const double* got, double x, double y, double z) {\n"
                 "  return got[0] * x + got[1] * y + got[2] * z;\n}\n\n";
    }
    if (text.find("length_of(") != std::string::npos) {
      helpers += start +
                 "double length_of(const double* got) {\n"
                 "  return sqrt(got[0] * got[0] + got[1] * got[1] + got[2] * got[2]);\n}\n\n";
    }
    return helpers;
  }
  /// printf of the answer.
  std::string print() const {
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
    return fmt::format("\"got: {}\\n\"{}{}", format, arguments.empty() ? "" : ",\n    ",
                       arguments.empty() ? "" : arguments.substr(2));
  }

 private:
  std::size_t count(std::size_t member) const {
    const Layout::Part& part = query_.layout.parts[member];
    return part.end - part.begin;
  }
  const char* absolute() const { return in_c_ ? "fabs" : "std::abs"; }
  std::string name(std::size_t member) const { return variable_of(query_.layout.parts[member].name); }
  std::string element(std::size_t member, std::size_t i) const {
    return count(member) == 1 ? name(member) : fmt::format("{}[{}]", name(member), i);
  }
  std::string matches(const RightAnswer& r) const {
    std::vector<std::string> all;
    if (decides(query_.kind)) all.push_back(r.yes ? "got_yes" : "!got_yes");
    for (const MemberCondition& c : r.members) {
      std::vector<std::string> own = conditions(c);
      if (in_c_ && !own.empty()) {  // a plugin may leave the member out
        all.push_back(
            fmt::format("(!{} || ({}))", flag_of(query_.layout.parts[c.member].name), fmt::join(own, " && ")));
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
      return {fmt::format("is_near({}, {}, {}, {}, {})", name(c.member), literal(c.values[0]), literal(c.values[1]),
                          literal(c.values[2]), literal(c.tolerance))};
    }
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const std::string got = element(c.member, i), right = literal(c.values[i]);
      all.push_back(c.tolerance == 0 ? fmt::format("{} == {}", got, right)
                                     : fmt::format("{}({} - {}) <= {}", absolute(), got, right, literal(c.tolerance)));
    }
    return all;
  }
  std::vector<std::string> normal_conditions(const MemberCondition& c) const {
    std::vector<std::string> all{
        fmt::format("{}(length_of({}) - 1) <= {}", absolute(), name(c.member), literal(c.tolerance))};
    for (const MemberCondition::Face& f : c.faces) {
      const std::string along = fmt::format("along({}, {}, {}, {})", name(c.member), literal(f.direction[0]),
                                            literal(f.direction[1]), literal(f.direction[2]));
      if (std::isfinite(f.low)) all.push_back(fmt::format("{} >= {}", along, literal(f.low - c.tolerance)));
      if (std::isfinite(f.high)) all.push_back(fmt::format("{} <= {}", along, literal(f.high + c.tolerance)));
    }
    return all;
  }
  std::string unit_test() const {
    std::string text;
    for (const std::size_t m : compared_) {
      if (query_.layout.parts[m].role != Role::normal || right_.unit_error == 0) continue;
      const std::string given = in_c_ ? flag_of(query_.layout.parts[m].name) + " && " : "";
      text += fmt::format("if ({}{}!({}(length_of({}) - 1) <= {})) got_right = {};\n",
                          decides(query_.kind) ? "got_yes && " : "", given, absolute(), name(m),
                          literal(right_.unit_error), in_c_ ? "0" : "false");
    }
    return text;
  }

  const Query& query_;
  const RightAnswers& right_;
  const std::vector<std::size_t>&members_, &compared_;
  bool in_c_;
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
  if (r.answer.status != Answer::Status::answered || r.answer.yes != r.truth.yes) return members;
  std::erase_if(members, [&](std::size_t m) { return !r.answer.gives(r.question.query->layout.parts[m].begin); });
  return members;
}

/// Writes the parts of the file.
class Emitter {
 public:
  Emitter(const Report& r, const Asking& asking, const RightAnswers& right, const std::vector<std::size_t>& declared,
          const std::vector<std::size_t>& compared)
      : r_(r),
        asking_(asking),
        right_(right),
        in_c_(asking.style == Asking::Style::c),
        conditions_(r, right, declared, compared, in_c_) {}

  std::string text() const {
    const std::string test = indented(body());
    const std::string helpers = conditions_.helpers_of(test, in_c_) + asking_.helpers;
    std::string text = heading() + includes() + "\n";
    if (!helpers.empty()) text += in_c_ ? helpers + "\n" : "namespace {\n\n" + helpers + "\n}  // namespace\n\n";
    text += start() + test + "}\n";
    if (asking_.style == Asking::Style::googletest_with_main) text += std::string(main_of_tests);
    return text;
  }

 private:
  static constexpr std::string_view main_of_tests = R"(
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
)";
  /// A call that never returns is ended after so many seconds.
  static constexpr int patience = 10;

  bool googletest() const {
    return asking_.style == Asking::Style::googletest || asking_.style == Asking::Style::googletest_with_main;
  }
  bool late() const { return r_.finding.verdict == Verdict::broke && r_.answer.late(); }
  std::string paragraph(const std::string& text) const {
    return wrapped_text(in_c_comment(text), in_c_ ? " * " : "// ", 100);
  }
  std::string heading() const {
    const std::string empty = in_c_ ? " *\n" : "//\n";
    return (in_c_ ? "/*\n" : "") + paragraph(headline(r_) + ".") + empty + paragraph(explanation(r_)) +
           paragraph(allowance_text(r_, right_) + ".") + empty +
           paragraph(fmt::format("Seen with {} ({}). Build:", r_.version, r_.subject)) + (in_c_ ? " *   " : "//   ") +
           in_c_comment(asking_.build) + "\n" + paragraph(fmt::format("Written by Nearmiss {}.", version())) +
           (in_c_ ? " */\n" : "");
  }
  std::string includes() const {
    std::string text = asking_.includes + "\n";
    if (googletest()) text += "#include <gtest/gtest.h>\n\n";
    text += in_c_ ? "#include <math.h>\n#include <stdio.h>\n" : "#include <cmath>\n#include <cstdio>\n";
    if (late()) text += "#include <unistd.h>\n";
    return text;
  }
  std::string start() const {
    if (in_c_) return "int main(void) {\n";
    if (!googletest()) return "int main() {\n";
    std::string name = fmt::format("{}_{}_{}", r_.question.query->name, fault_of(r_.finding), id_of(r_));
    std::replace(name.begin(), name.end(), '-', '_');
    return fmt::format("TEST({}, {}) {{\n", asking_.suite, name);
  }
  std::string body() const {
    std::string text;
    if (late()) text += fmt::format("alarm({});{}\n", patience, in_c_ ? "" : "  // the library does not return");
    if (decides(r_.question.query->kind)) text += in_c_ ? "int got_yes = 0;\n" : "bool got_yes = false;\n";
    text += conditions_.declarations() + asking_.statements + "\n";
    const std::string truth = in_c_comment("Exactly, " + truth_text(*r_.question.query, r_.truth) + ".");
    return text + (in_c_ ? "/* " + truth + " */\n" : "// " + truth + "\n") + conditions_.test() + verdict();
  }
  std::string verdict() const {
    const std::string print = in_c_ ? "printf" : "std::printf";
    const std::string fault = is_bad(r_.finding) ? fault_of(r_.finding) : "not-right";
    const std::string shown = fmt::format("{}({});\n", print, conditions_.print());
    if (googletest()) return fmt::format("if (!got_right) {}EXPECT_TRUE(got_right) << \"{}\";\n", shown, fault);
    return shown + fmt::format("if (!got_right) {}(\"FAILED: {}\\n\");\nreturn got_right ? 0 : 1;\n", print, fault);
  }

  const Report& r_;
  const Asking& asking_;
  const RightAnswers& right_;
  bool in_c_;
  Conditions conditions_;
};

}  // namespace

namespace {

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
  const std::string extension = asking.style == Asking::Style::c ? "c" : "cpp", usual = "test." + extension;
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
