/// Batches as a program gets and answers them over pipes. What it says is not believed: a reply is an answer or an
/// error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "impl/host/wire.hpp"

namespace nearmiss::wire {

/// How deep lists and objects of JSON are within each other. What is nested without end is not to be copied or printed,
/// which its library does by calling itself.
std::size_t nesting(std::string_view json);
inline constexpr std::size_t most_nested = 64;

/// A batch in binary, and as one line of JSON: {"query": "...", "first": N, "cases": [[...], ...]}.
std::string binary_request(std::uint32_t offer, std::uint32_t first, std::span<const double> values,
                           std::size_t inputs);
std::string json_request(std::string_view query, std::uint32_t first, std::span<const double> values,
                         std::size_t inputs);

/// The reply to the case `number`, or what is wrong with it, or neither where it has not come to its end yet.
struct Taken {
  std::size_t bytes = 0;  ///< that the reply takes; 0: not all of it is there
  Answer answer{};
  std::string error{};
};
Taken take_binary(std::string_view bytes, std::uint32_t number, std::size_t outputs);
Taken take_json(std::string_view bytes, std::uint32_t number, std::size_t outputs);

}  // namespace nearmiss::wire
