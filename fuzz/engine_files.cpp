/// Writes the files that fuzzing engines read beside a target: FOLDER/fuzz_TARGET.dict, the bytes of special numbers in
/// both scalars, and FOLDER/fuzz_TARGET.options, libFuzzer's options and the address sanitizer's, as OSS-Fuzz reads
/// them. Usage: engine_files TARGET FOLDER
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/fuzz_target.hpp"

namespace nearmiss {
namespace {

/// Numbers at which floating-point arithmetic changes its behaviour. Without infinity and NaN, which are no inputs.
template <class T>
std::vector<std::pair<std::string, T>> special_numbers() {
  using Limits = std::numeric_limits<T>;
  const T root = std::ldexp(T(1), (Limits::max_exponent - 1) / 2);  // the square of a number above it overflows
  std::vector<std::pair<std::string, T>> all{
      {"zero", T(0)},
      {"one", T(1)},
      {"half", T(0.5)},
      {"two", T(2)},
      {"one_below_one", 1 - Limits::epsilon() / 2},
      {"one_above_one", 1 + Limits::epsilon()},
      {"epsilon", Limits::epsilon()},
      {"smallest", Limits::denorm_min()},
      {"largest_subnormal", Limits::min() - Limits::denorm_min()},
      {"smallest_normal", Limits::min()},
      {"largest", Limits::max()},
      {"largest_with_square", root},
      {"smallest_with_square", 1 / root},
      {"consecutive_integers_end", std::ldexp(T(1), Limits::digits)},
      {"third", T(1) / 3},
      {"tenth", T(0.1)},
  };
  const std::size_t positive = all.size();
  for (std::size_t i = 0; i < positive; ++i) all.emplace_back("minus_" + all[i].first, -all[i].second);
  return all;
}

/// An entry of the dictionary: a name, and the bytes of the number in the order of the codec (little-endian).
template <class Bits, class T>
std::string entry(const std::string& name, T value) {
  std::string text = name + "=\"";
  const Bits bits = std::bit_cast<Bits>(value);
  for (std::size_t i = 0; i < sizeof(Bits); ++i) text += fmt::format("\\x{:02x}", (bits >> (8 * i)) & 0xFF);
  return text + "\"\n";
}

std::string dictionary() {
  std::string text = "# Written by engine_files: special numbers as the bytes of a case.\n";
  for (const auto& [name, value] : special_numbers<float>()) text += entry<std::uint32_t>("float_" + name, value);
  for (const auto& [name, value] : special_numbers<double>()) text += entry<std::uint64_t>("double_" + name, value);
  return text;
}

/// Seconds for one case. A subject that needs longer loops.
constexpr int timeout = 10;

/// A case of a query has one of two lengths, one for each scalar: longer inputs have surplus bytes, and libFuzzer must
/// not begin with short ones. fuzz_target.cpp says why branches are not counted. The oracle is not instrumented, so a
/// vector of libc++ that it has filled looks overfull.
std::string options(const FuzzTarget& target) {
  std::size_t longest = 0;
  for (const Query* q : target.queries) {
    longest = std::max(longest, case_to_bytes(generate(*q, Scalar::float64, 1, 0)).size());
  }
  return fmt::format(
      "[libfuzzer]\n"
      "len_control = 0\n"
      "use_counters = 0\n"
      "max_len = {}\n"
      "timeout = {}\n"
      "\n"
      "[asan]\n"
      "detect_container_overflow = 0\n",
      longest, timeout);
}

void write_engine_files(const FuzzTarget& target, const std::filesystem::path& folder) {
  make_folder(folder);
  write_file(folder / fmt::format("fuzz_{}.dict", target.name), dictionary());
  write_file(folder / fmt::format("fuzz_{}.options", target.name), options(target));
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) try {
  using namespace nearmiss;
  if (argc != 3) throw BadInput("engine_files: expects two arguments, TARGET and FOLDER");
  const FuzzTarget* target = find_fuzz_target(argv[1]);
  if (target == nullptr) throw BadInput(fmt::format("engine_files: {} is no fuzz target", argv[1]));
  write_engine_files(*target, argv[2]);
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
