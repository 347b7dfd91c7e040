#include "reports/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace nearmiss {

namespace {

/// Every referee that offers the query and can hold the case's numbers, but for the subject itself.
std::vector<Opinion> second_opinions(const Case& question, const Subject& subject, Workers& workers) {
  std::vector<Opinion> opinions;
  for (const Subject& referee : subjects()) {
    if (!referee.referee || referee.name == subject.name) continue;
    const Offering& offering = referee.offering(question.query->name);
    if (offering.answer == nullptr) continue;
    const std::optional<Case> same = in_scalar(question, referee.scalar);
    if (!same) continue;
    const Answer answer = workers.ask(referee, *same);
    opinions.push_back({referee.name, referee.version, answer, judge(*same, answer, {}, Detail::full)});
  }
  return opinions;
}

class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const unsigned char c : bytes) hash_ = (hash_ ^ c) * 0x100000001b3u;
    hash_ = (hash_ ^ 0xffu) * 0x100000001b3u;
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace

Report examine(const Case& question, const Subject& subject, Workers& workers) {
  return examine(question, subject, workers.ask(subject, question), workers);
}

Report examine(const Case& question, const Subject& subject, const Answer& answer, Workers& workers) {
  Report r;
  r.question = question;
  r.subject = subject.name;
  r.version = subject.version;
  r.answer = answer;
  r.contract = subject.offering(question.query->name).contract;
  r.finding = judge(question, answer, r.contract, Detail::full);
  r.truth = truth_of(question);
  r.referees = second_opinions(question, subject, workers);
  return r;
}

bool is_bad(const Finding& f) { return f.verdict == Verdict::violates_contract || f.verdict == Verdict::broke; }

std::string fault_of(const Finding& f) {
  std::string fault(f.verdict == Verdict::broke ? name_of(f.verdict) : name_of(f.disagreement));
  std::replace(fault.begin(), fault.end(), ' ', '-');
  return fault;
}

std::string id_of(const Report& r) {
  Fnv1a fnv;
  fnv.add(r.question.query->name);
  fnv.add(r.subject);
  fnv.add(fault_of(r.finding));
  for (const double x : r.question.values) fnv.add(fmt::format("{:016x}", std::bit_cast<std::uint64_t>(x)));
  return fmt::format("{:012x}", fnv.hash() >> 16);
}

bool is_part(const Query& query, const Answer& answer, std::size_t output) {
  if (answer.status != Answer::Status::answered || !answer.gives(output)) return false;
  if (answer.yes) return true;
  const Role role = query.outputs[output].role;
  return role == Role::depth || role == Role::flag || role == Role::index;
}

}  // namespace nearmiss
