#include "impl/catalogue/counted_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>

namespace nearmiss {

namespace {

std::size_t choices_of(const CountedInput& list) { return list.most - list.least + 1; }

bool is_count(double x, const CountedInput& list) {
  return x >= double(list.least) && x <= double(list.most) && x == double(std::size_t(x));
}

/// The count at that place of the values.
std::size_t count_at(std::span<const double> values, std::size_t place, const CountedInput& list) {
  if (place >= values.size() || !(values[place] > double(list.least))) return list.least;
  return values[place] >= double(list.most) ? list.most : std::size_t(values[place]);
}

}  // namespace

/// The fields for each choice of counts, described when they are first asked for.
class CountedInputs::Described {
 public:
  Described(const std::vector<CountedInput>& lists, Describe describe) : describe_(describe) {
    std::size_t choices = 1;
    for (const CountedInput& list : lists) choices *= choices_of(list);
    known_ = std::vector<std::atomic<const InputFields*>>(choices);
  }
  const InputFields& of(std::size_t choice, const std::vector<CountedInput>& lists) {
    if (const InputFields* known = known_[choice].load(std::memory_order_acquire)) return *known;
    const std::lock_guard lock(mutex_);
    if (const InputFields* known = known_[choice].load(std::memory_order_relaxed)) return *known;
    owned_.push_back(std::make_unique<const InputFields>(describe_(counts_of(choice, lists))));
    known_[choice].store(owned_.back().get(), std::memory_order_release);
    return *owned_.back();
  }

 private:
  /// The counts of a choice, whose last digit is that of the last list.
  static std::vector<std::size_t> counts_of(std::size_t choice, const std::vector<CountedInput>& lists) {
    std::vector<std::size_t> counts(lists.size());
    for (std::size_t k = lists.size(); k-- > 0; choice /= choices_of(lists[k]))
      counts[k] = lists[k].least + choice % choices_of(lists[k]);
    return counts;
  }

  Describe describe_;
  std::vector<std::atomic<const InputFields*>> known_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<const InputFields>> owned_;
};

CountedInputs::CountedInputs(std::vector<CountedInput> lists, std::size_t fewest, Describe describe)
    : lists_(std::move(lists)), fewest_(fewest) {
  if (!lists_.empty()) described_ = std::make_shared<Described>(lists_, describe);
}

std::size_t CountedInputs::place_of_count(std::size_t list, std::span<const double> values) const {
  std::size_t further = 0;
  for (std::size_t k = 0; k < list; ++k)
    further += (count_at(values, lists_[k].at + further, lists_[k]) - lists_[k].least) * lists_[k].numbers;
  return lists_[list].at + further;
}

std::size_t CountedInputs::count_of(std::size_t list, std::span<const double> values) const {
  return count_at(values, place_of_count(list, values), lists_[list]);
}

std::size_t CountedInputs::numbers(std::span<const double> values) const {
  std::size_t further = 0;
  for (const CountedInput& list : lists_)
    further += (count_at(values, list.at + further, list) - list.least) * list.numbers;
  return fewest_ + further;
}

std::size_t CountedInputs::most_numbers() const {
  std::size_t most = fewest_;
  for (const CountedInput& list : lists_) most += (list.most - list.least) * list.numbers;
  return most;
}

std::optional<Invalid> CountedInputs::broken(std::span<const double> values) const {
  for (std::size_t k = 0; k < lists_.size(); ++k) {
    const CountedInput& list = lists_[k];
    const std::size_t place = place_of_count(k, values);
    const double count = place < values.size() ? values[place] : 0;
    if (place >= values.size() || !is_count(count, list))
      return Invalid{list.name + ".count", count, fmt::format("a whole number from {} to {}", list.least, list.most)};
  }
  if (values.size() == numbers(values)) return std::nullopt;
  const std::size_t last = lists_.size() - 1;
  return Invalid{lists_[last].name + ".count", double(count_of(last, values)), "the number of its entries"};
}

const InputFields& CountedInputs::fields(std::span<const double> values) const {
  std::size_t choice = 0, further = 0;
  for (const CountedInput& list : lists_) {
    const std::size_t count = count_at(values, list.at + further, list);
    choice = choice * choices_of(list) + (count - list.least);
    further += (count - list.least) * list.numbers;
  }
  return described_->of(choice, lists_);
}

}  // namespace nearmiss
