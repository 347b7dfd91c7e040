/// Encodes batches for pipes, and decodes the replies of a program. The decoders trust no byte: a reply is an answer or
/// an error.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/query.hpp"
#include "impl/host/wire.hpp"

namespace nearmiss::wire {

/// The nesting depth of lists and objects in JSON text. The JSON library copies and prints recursively, so deeper text
/// than most_nested is refused.
std::size_t nesting(std::string_view json);
inline constexpr std::size_t most_nested = 64;

/// The names of a query's numbers: {"query": "...", "decides": true, "inputs": [...], "outputs": [...]}. In the place
/// of a list of inputs stands {"list": "hull.vertices", "entry": ["x", "y", "z"]}.
nlohmann::json names_of_numbers(const Query& query);
/// One line, {"names": [...]}, with those of each offer of a checked hello.
std::string names_of_offers(std::string_view hello);

/// A batch in binary for a program of that version, or as one line of JSON: {"query": "...", "first": N, "cases":
/// [[...], ...]}.
std::string binary_request(std::uint32_t offer, std::uint32_t first, const CaseNumbers& cases,
                           int of_version = version);
std::string json_request(std::string_view query, std::uint32_t first, const CaseNumbers& cases);

/// The name of a member that an object of the text, which is JSON, has twice; empty where each is there once. `parsed`
/// is the same text, parsed.
std::optional<std::string> repeated_member(std::string_view json, const nlohmann::json& parsed);

/// The first difference between two hellos: "version was 1 and is 2". Empty where they say the same, also in another
/// order of members. The first one is valid JSON.
std::optional<std::string> difference_between(std::string_view first, std::string_view now);

/// The outputs of that name or in the vector of that name: bit i for output i. 0 where there is none.
std::uint64_t bits_of_output(const Query& query, std::string_view name);
/// For each offer of a checked hello the outputs that it gives: those of its list "gives", or all.
std::vector<std::uint64_t> given_by_offers(std::string_view hello);

/// A decoded reply: an answer, or an error, or neither while the reply is incomplete.
struct Taken {
  std::size_t bytes = 0;  ///< length of the reply; 0: it is incomplete or an error
  Answer answer{};
  std::string error{};
  bool names_its_case = false;  ///< of an error: the reply names the case that is due, so it is the reply to this case
};
/// What the reply must be like.
struct Due {
  std::uint32_t number = 0;                 ///< of the case
  std::size_t outputs = 0;                  ///< count of the numbers
  std::uint64_t gives = ~std::uint64_t{0};  ///< bit i: the offer gives number i
  std::uint64_t of_misses = 0;              ///< bit i: number i is also part of a miss
};
/// Decodes the reply that is due at the beginning of `bytes`. In JSON, null in the place of a number that the offer
/// gives is a number that is not finite, for JSON has no other word for it; "none" leaves the number out of the answer.
Taken take_binary(std::string_view bytes, const Due& due);
Taken take_json(std::string_view bytes, const Due& due);

}  // namespace nearmiss::wire
