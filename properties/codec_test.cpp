/// Cases survive both codecs, and files that are no cases are refused with one clear line.
#include "corpus/codec.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "corpus/generator.hpp"
#include "corpus/store.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// Bitwise equality: -0.0 differs from 0.0.
void expect_same(const Case& a, const Case& b) {
  EXPECT_EQ(a.query, b.query);
  EXPECT_EQ(a.scalar, b.scalar);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.values[i]), std::bit_cast<std::uint64_t>(b.values[i])) << i;
  }
}

Case from_text(const std::string& text) { return case_from_json(parse_json(text, "file.json"), "file.json"); }

class Codec : public testing::TestWithParam<NamedQuery> {};

/// Generated cases, and one whose numbers are hard to print.
std::vector<Case> cases_of(const Query& query, Scalar scalar) {
  std::vector<Case> all;
  for (std::uint64_t i = 0; i < 500; ++i) all.push_back(generate(query, scalar, 11, i));
  const bool is_float = scalar == Scalar::float32;
  const double hard[] = {-0.0, is_float ? double(0x1p-149f) : 0x1p-1074, largest_finite(scalar),
                         is_float ? double(0.1f) : 0.1, is_float ? double(1 - 0x1p-24f) : 1 - 0x1p-53};
  Case c = all.front();
  std::size_t first = 0;
  do {  // in an order that keeps the rules between two numbers
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const Role role = query.inputs[i].role;
      if (role != Role::flag && role != Role::index) c.values[i] = hard[(first + i) % std::size(hard)];
    }
  } while (query.broken(c.values) && ++first < std::size(hard));
  all.push_back(c);
  return all;
}

TEST_P(Codec, BringsACaseBackFromJsonText) {
  for (Scalar scalar : scalars) {
    for (const Case& c : cases_of(*GetParam().query, scalar)) {
      const Case back = from_text(case_to_json(c).dump(2));
      expect_same(c, back);
      EXPECT_EQ(c.origin, back.origin);
      EXPECT_EQ(c.seed, back.seed);
      EXPECT_EQ(c.index, back.index);
      EXPECT_EQ(c.moves, back.moves);
    }
  }
}

TEST_P(Codec, BringsACaseBackFromBytes) {
  for (Scalar scalar : scalars) {
    for (const Case& c : cases_of(*GetParam().query, scalar)) {
      const auto back = case_from_bytes(*GetParam().query, case_to_bytes(c));
      ASSERT_TRUE(back);
      expect_same(c, *back);
    }
  }
}

TEST_P(Codec, TakesNoBytesThatAreTooFewAndIgnoresThoseBeyond) {
  const Query& query = *GetParam().query;
  for (Scalar scalar : scalars) {
    const Case c = generate(query, scalar, 11, 0);
    std::vector<std::uint8_t> bytes = case_to_bytes(c);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      EXPECT_FALSE(case_from_bytes(query, std::span(bytes).first(n))) << n;
    }
    bytes.push_back(0xff);
    ASSERT_TRUE(case_from_bytes(query, bytes));
    expect_same(c, *case_from_bytes(query, bytes));
  }
}

TEST_P(Codec, TakesNoBytesThatBreakARule) {
  const Query& query = *GetParam().query;
  Case c = generate(query, Scalar::float64, 11, 0);
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = query.inputs[i].role;
    if (role == Role::flag || role == Role::index) continue;
    Case bad = c;
    bad.values[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(case_from_bytes(query, case_to_bytes(bad))) << query.inputs[i].name;
    bad.values[i] = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(case_from_bytes(query, case_to_bytes(bad))) << query.inputs[i].name;
  }
}

TEST_P(Codec, NamesEveryInputThatIsMissing) {
  const nlohmann::json whole = parse_json(case_to_json(generate(*GetParam().query, Scalar::float64, 1, 0)).dump(), "");
  for (const auto& item : whole["inputs"].items()) {
    nlohmann::json j = whole;
    j["inputs"].erase(item.key());
    try {
      (void)case_from_json(j, "file.json");
      ADD_FAILURE() << "read without inputs." << item.key();
    } catch (const BadInput& e) {
      EXPECT_EQ(std::string(e.what()), "file.json: inputs." + item.key() + " is missing");
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, Codec, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

TEST(CaseToCpp, GivesInputsThatCompileAndMeanTheSame) {
  const Case c{find_query("moving_point_sphere"),
               Scalar::float32,
               {1, -0.0, double(0.1f), 0, 0, -1, 0, 0, 0, 2, 1},
               "",
               0,
               0,
               {}};
  EXPECT_EQ(case_to_cpp(c),
            "const nearmiss::inputs::moving_point_sphere<float> question{.point = {1.0f, -0.0f, 0.1f}, "
            ".velocity = {0.0f, 0.0f, -1.0f}, .sphere = {.center = {0.0f, 0.0f, 0.0f}, .radius = 2.0f}, "
            ".solid = true};\nconst auto answer = nearmiss::adapters::ask_collide<collide::Fast>(question);\n");
}

TEST(FieldsToJson, WritesNumbersThatJsonLacksAsWords) {
  const Field fields[] = {{"time", Role::time},
                          {"contacts.0.x", Role::position},
                          {"contacts.0.y", Role::position},
                          {"contacts.0.z", Role::position}};
  const double values[] = {HUGE_VAL, -HUGE_VAL, std::nan(""), 1};
  EXPECT_EQ(fields_to_json(fields, values).dump(), R"({"time":"Infinity","contacts":[["-Infinity","NaN",1.0]]})");
}

// Files that are no cases. Each message names the file, the field, the value and the rule.

struct BadFile {
  const char* name;
  const char* text;
  std::vector<const char*> words;
};

std::string sphere_case(const std::string& inputs) {
  return R"({"query": "moving_point_sphere", "scalar": "double", "inputs": )" + inputs + "}";
}

const BadFile bad_files[] = {
    {"Empty", "", {"file.json", "is empty"}},
    {"NotJson", "hello", {"file.json", "line 1"}},
    {"NoObject", "[1, 2]", {"the case is [1,2]", "an object"}},
    {"NoQuery", R"({"scalar": "double", "inputs": {}})", {"query is missing"}},
    {"UnknownQuery",
     R"({"query": "moving_cone", "scalar": "double", "inputs": {}})",
     {"query is \"moving_cone\"", "list"}},
    {"QueryIsANumber", R"({"query": 3, "scalar": "double", "inputs": {}})", {"query is 3", "a string"}},
    {"UnknownScalar",
     R"({"query": "moving_point_sphere", "scalar": "half", "inputs": {}})",
     {"scalar is \"half\"", "\"float\" or \"double\""}},
    {"SurplusField",
     R"({"query": "moving_point_sphere", "scalar": "double", "inputs": {}, "colour": 1})",
     {"colour is unknown"}},
    {"InputsAreAList",
     R"({"query": "moving_point_sphere", "scalar": "double", "inputs": [1]})",
     {"inputs is [1]", "an object"}},
};

const BadFile bad_inputs[] = {
    {"MissingMember",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5]}, "solid": true})",
     {"inputs.sphere.radius is missing"}},
    {"SurplusMember",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1, "diameter": 2}, "solid": true})",
     {"inputs.sphere.diameter is unknown"}},
    {"TwiceTheSame",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1, "radius": 2}, "solid": true})",
     {"inputs.sphere.radius is given twice"}},
    {"ShortVector",
     R"({"point": [0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.point is [0,0]", "an array of 3"}},
    {"LongVector",
     R"({"point": [0,0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.point is [0,0,0,0]", "an array of 3"}},
    {"VectorByNames",
     R"({"point": {"x": 0, "y": 0, "z": 0}, "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.point is {", "an array of 3"}},
    {"TextForNumber",
     R"({"point": [0,"0",0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.point.y is \"0\"", "a number"}},
    {"NullForNumber",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": null}, "solid": true})",
     {"inputs.sphere.radius is null", "a number"}},
    {"NumberForFlag",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": 1})",
     {"inputs.solid is 1", "true or false"}},
    {"NegativeRadius",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": -1}, "solid": true})",
     {"inputs.sphere.radius is -1", "not negative"}},
    {"NotANumber",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": NaN}, "solid": true})",
     {"inputs.sphere.radius", "line 1"}},
    {"Infinity",
     R"({"point": [0,0,0], "velocity": [0,-Infinity,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.velocity[1]", "line 1"}},
    {"BeyondDouble",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"center": [0,0,1e999], "radius": 1}, "solid": true})",
     {"inputs.sphere.center[2] is 1e999", "within the range of double"}},
    {"BelowDouble",
     R"({"point": [0,0,0], "velocity": [0,0,1e-400], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.velocity[2] is 1e-400", "from zero"}},
};

void expect_refused(const std::string& text, const std::vector<const char*>& words) {
  try {
    (void)from_text(text);
    ADD_FAILURE() << "was read as a case";
  } catch (const BadInput& e) {
    const std::string line = e.what();
    EXPECT_TRUE(line.starts_with("file.json: ")) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    for (const char* word : words) EXPECT_NE(line.find(word), std::string::npos) << line << "\nlacks: " << word;
  }
}

TEST(BadFiles, AreRefusedWithOneLineThatSaysWhy) {
  for (const BadFile& b : bad_files) {
    SCOPED_TRACE(b.name);
    expect_refused(b.text, b.words);
  }
}

TEST(BadInputs, AreRefusedWithFieldValueAndRule) {
  for (const BadFile& b : bad_inputs) {
    SCOPED_TRACE(b.name);
    expect_refused(sphere_case(b.text), b.words);
  }
}

TEST(BadInputs, AreRefusedWhenAFloatCannotHoldThem) {
  const std::string text = R"({"query": "closest_point_segment", "scalar": "float",
    "inputs": {"segment": {"v0": [0, 0, 0.1], "v1": [1, 0, 0]}, "point": [0, 0, 0]}})";
  expect_refused(text, {"inputs.segment.v0.z is 0.1", "exactly a float", "0.10000000149011612"});
}

TEST(BadInputs, AreRefusedForAnIndexThatIsNoInteger) {
  nlohmann::json j =
      parse_json(case_to_json(generate(*find_query("box_box_overlap"), Scalar::float64, 1, 0)).dump(), "");
  j["inputs"]["hint"] = 1.5;
  expect_refused(j.dump(), {"inputs.hint is 1.5", "an integer"});
}

TEST(BadInputs, AreRefusedForAZeroQuaternion) {
  nlohmann::json j =
      parse_json(case_to_json(generate(*find_query("box_box_overlap"), Scalar::float64, 1, 0)).dump(), "");
  j["inputs"]["box2"]["orientation"] = {{"x", 0}, {"y", 0}, {"z", 0}, {"w", 0}};
  expect_refused(j.dump(), {"inputs.box2.orientation", "not all of x, y, z, w zero"});
}

TEST(BadInputs, AreRefusedForAnUnknownMove) {
  nlohmann::json j =
      parse_json(case_to_json(generate(*find_query("box_box_overlap"), Scalar::float64, 1, 0)).dump(), "");
  j["origin"]["moves"] = {"sideways"};
  expect_refused(j.dump(), {"origin.moves is \"sideways\"", "the name of a move"});
}

TEST(BadInputs, AreRefusedWhenNestedWithoutEnd) { expect_refused(std::string(100000, '['), {"nested more than"}); }

// Files.

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("nearmiss-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::size_t entries() const {
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }
  std::filesystem::path folder_;
};

TEST_F(Files, AreWrittenWholeAndLeaveNothingElseBehind) {
  write_file(folder_ / "a.txt", "one");
  write_file(folder_ / "a.txt", "two");
  EXPECT_EQ(read_file(folder_ / "a.txt"), "two");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, ThatCannotBeWrittenAreNamedWithTheReason) {
  std::filesystem::create_directories(folder_ / "a folder");
  for (const auto& file : {folder_ / "missing" / "a.txt", folder_ / "a folder"}) {
    try {
      write_file(file, "x");
      ADD_FAILURE() << "wrote " << file;
    } catch (const IoError& e) {
      EXPECT_TRUE(std::string(e.what()).starts_with(file.string() + ": cannot be written: ")) << e.what();
    }
  }
  EXPECT_EQ(entries(), 1u) << "something half-written stays behind";
}

TEST_F(Files, ThatCannotBeReadAreNamedWithTheReason) {
  EXPECT_THROW((void)read_case(folder_), BadInput);
  try {
    (void)read_case(folder_ / "missing.json");
    ADD_FAILURE();
  } catch (const BadInput& e) {
    EXPECT_EQ(std::string(e.what()),
              (folder_ / "missing.json").string() + ": cannot be read: No such file or directory");
  }
}

TEST_F(Files, OfStoredCasesRefuseWordsThatTheJudgeNeverSays) {
  const auto refused = [&](const std::string& expected, const char* words) {
    auto j = case_to_json(generate(*find_query("closest_point_segment"), Scalar::float64, 1, 0));
    j["expected"] = nlohmann::ordered_json::parse(expected);
    write_file(folder_ / "case.json", j.dump());
    try {
      (void)read_stored_case(folder_ / "case.json");
      ADD_FAILURE() << expected;
    } catch (const BadInput& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  refused(R"([{"subject": "x", "verdict": "fine"}])", "expected[0].verdict is \"fine\"");
  refused(R"([{"verdict": "agrees"}])", "expected[0].subject is missing");
  refused(R"([{"subject": "x", "verdict": "agrees", "disagreement": "odd"}])", "expected[0].disagreement is \"odd\"");
  refused(R"([{"subject": "x", "verdict": "agrees", "why": "odd"}])", "expected[0].why is unknown");
  refused(R"({})", "expected is {}");
}

}  // namespace
}  // namespace nearmiss
