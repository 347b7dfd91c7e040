/// Subjects with a mistake in one query, for the tests of causes.
#pragma once

#include <gtest/gtest.h>

#include <cfenv>
#include <chrono>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "corpus/generator/fit.hpp"
#include "corpus/generator/generator.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/triage/hypotheses/cause_of.hpp"

namespace nearmiss {

using Numbers = std::span<const double>;
using Answering = Answer (*)(Numbers);

inline Answer exact_answer(const char* query, Numbers values) {
  static const Subject certified = [] {
    for (const Subject& own : own_subjects_in_process()) {
      if (own.name == "collide-certified-double") return own;
    }
    throw std::logic_error("no certified tier");
  }();
  const Answer a = certified.offering(query).answer(values);
  std::feclearexcept(FE_OVERFLOW | FE_UNDERFLOW);  // those of exact arithmetic are none of the mistaken subject's
  return a;
}

/// A subject with a mistake in one query, and the contract of a precise one.
inline Subject subject_with(const char* query, Answering answer) {
  Subject s{.name = "mistaken", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  s.offerings.push_back({query, Offer::answers, "", collide::Contract{.backward = 64}, answer, {}});
  return s;
}

inline Case in_double(const char* query, std::vector<double> values) {
  return {find_query(query), Scalar::float64, std::move(values), "test", 0, 0, {}};
}

inline Cause cause_found(const Subject& subject, const Case& question) {
  Workers workers;
  const Report report = examine(question, subject, workers);
  EXPECT_TRUE(is_bad(report.finding)) << "the mistake is not found";
  return cause_of(report, subject, {.time = std::chrono::hours(1)}, workers);  // also on a busy machine
}

/// The first generated case that counts against the subject.
inline Case first_wrong(const Subject& s) {
  Workers workers;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Case c;
    generate_inside(c, *find_query(s.offerings[0].query), s.scalar, 1, i, {});
    if (!has_extreme_mutator(c) && is_bad(examine(c, s, workers).finding)) return c;
  }
  throw std::logic_error("no finding");
}

inline void expect_cause(const Cause& c, CauseKind kind, const std::string& key) {
  EXPECT_EQ(c.kind, kind) << cause_text(c);
  EXPECT_EQ(c.key, key) << cause_text(c);
}

}  // namespace nearmiss
