/// Encodes batches for pipes, and decodes the replies of a program. The decoders trust no byte: a reply is an answer or
/// an error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "impl/host/wire.hpp"

namespace nearmiss::wire {

/// The nesting depth of lists and objects in JSON text. The JSON library copies and prints recursively, so deeper text
/// than most_nested is refused.
std::size_t nesting(std::string_view json);
inline constexpr std::size_t most_nested = 64;

/// A batch in binary, or as one line of JSON: {"query": "...", "first": N, "cases": [[...], ...]}.
std::string binary_request(std::uint32_t offer, std::uint32_t first, std::span<const double> values,
                           std::size_t inputs);
std::string json_request(std::string_view query, std::uint32_t first, std::span<const double> values,
                         std::size_t inputs);

/// A decoded reply: an answer, or an error, or neither while the reply is incomplete.
struct Taken {
  std::size_t bytes = 0;  ///< length of the reply; 0: it is incomplete or an error
  Answer answer{};
  std::string error{};
};
/// Decodes the reply to the case `number` at the beginning of `bytes`.
Taken take_binary(std::string_view bytes, std::uint32_t number, std::size_t outputs);
Taken take_json(std::string_view bytes, std::uint32_t number, std::size_t outputs);

}  // namespace nearmiss::wire
