#include "reports/engine/wrong_cases.hpp"

#include <string_view>

namespace nearmiss {

namespace {

constexpr std::string_view digits_of_16 = "0123456789abcdef";
constexpr std::uint64_t cases_of_a_digit = 4;

}  // namespace

void WrongCases::add(const Case& c) {
  if (c.index >= wrong_.size()) wrong_.resize(c.index + 1);
  wrong_[c.index] = true;
}

std::string WrongCases::text() const {
  std::string digits;
  for (std::size_t first = 0; first < wrong_.size(); first += cases_of_a_digit) {
    std::size_t digit = 0;
    for (std::size_t i = 0; i < cases_of_a_digit && first + i < wrong_.size(); ++i)
      digit |= std::size_t{wrong_[first + i]} << i;
    digits += digits_of_16[digit];
  }
  return digits;
}

std::optional<WrongCases> WrongCases::from_text(const std::string& digits) {
  if (digits.size() * cases_of_a_digit > noted) return std::nullopt;
  WrongCases all;
  for (const char c : digits) {
    const std::size_t digit = digits_of_16.find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    for (std::size_t i = 0; i < cases_of_a_digit; ++i) all.wrong_.push_back((digit >> i & 1) != 0);
  }
  return all;
}

}  // namespace nearmiss
