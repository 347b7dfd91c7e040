/// Cases survive both codecs, and files that are no cases are refused with one clear line.
#include "corpus/storage/codec.hpp"
#include "corpus/storage/fuzz_target.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "corpus/files/near_words.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/storage/store.hpp"
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

TEST(FuzzTargets, AskEachQueryOnce) {
  std::size_t asked = 0;
  for (const FuzzTarget& t : fuzz_targets()) {
    EXPECT_EQ(find_fuzz_target(t.name), &t);
    ASSERT_FALSE(t.queries.empty()) << t.name;
    for (const Query* q : t.queries) EXPECT_EQ(&fuzz_target_of(*q), &t) << q->name;
    asked += t.queries.size();
  }
  EXPECT_EQ(asked, catalogue().size());
  EXPECT_EQ(fuzz_target_of(*find_query("box_box_signed_distance")).name, "signed_distance");
  EXPECT_EQ(fuzz_target_of(*find_query("capsule_box_overlap")).name, "overlap");
  EXPECT_EQ(fuzz_target_of(*find_query("sphere_box_overlap")).name, "sphere_box_overlap") << "not of the grid";
  EXPECT_EQ(find_fuzz_target("capsule_box_overlap"), nullptr);
}

TEST(FuzzTargets, ReadTheCasesThatTheyWrite) {
  for (const FuzzTarget& t : fuzz_targets()) {
    for (const Query* q : t.queries) {
      for (const Scalar scalar : scalars) {
        const Case c = generate(*q, scalar, 11, 0);
        const std::optional<Case> back = t.case_of(t.bytes_of(c));
        ASSERT_TRUE(back) << q->name;
        ASSERT_EQ(back->query, q);
        expect_same(c, *back);
      }
    }
    EXPECT_FALSE(t.case_of({})) << t.name;
  }
}

/// A fuzzer that changes the first byte asks another pair about the same numbers.
TEST(FuzzTargets, TakeAnyFirstByte) {
  const FuzzTarget& target = *find_fuzz_target("overlap");
  std::vector<std::uint8_t> bytes =
      target.bytes_of(generate(*find_query("triangle_box_overlap"), Scalar::float64, 3, 0));
  std::set<const Query*> read;
  for (int first = 0; first < 256; ++first) {
    bytes[0] = static_cast<std::uint8_t>(first);
    const std::optional<Case> c = target.case_of(bytes);
    if (!c) continue;  // the numbers break a rule of that pair
    EXPECT_EQ(c->query, target.queries[std::size_t(first / 2) % target.queries.size()]);
    EXPECT_EQ(c->scalar, first % 2 == 0 ? Scalar::float32 : Scalar::float64);
    read.insert(c->query);
  }
  EXPECT_GE(read.size(), 2u);
}

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
    {"UnknownQuery", R"({"query": "moving_cone", "scalar": "double", "inputs": {}})", {"unknown query 'moving_cone'"}},
    {"QueryIsANumber", R"({"query": 3, "scalar": "double", "inputs": {}})", {"query is 3", "a string"}},
    {"UnknownScalar",
     R"({"query": "moving_point_sphere", "scalar": "half", "inputs": {}})",
     {"scalar is \"half\"", "\"float\" or \"double\""}},
    {"SurplusField",
     R"({"query": "moving_point_sphere", "scalar": "double", "inputs": {}, "colour": 1})",
     {"colour is unknown", "it must be query, scalar, inputs, values, origin"}},
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
    {"VectorByOtherNames",
     R"({"point": {"a": 0, "y": 0, "z": 0}, "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.point.a is unknown", "x, y, z"}},
    {"VectorAsText",
     R"({"point": "0 0 0", "velocity": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.point is \"0 0 0\"", "an array of 3, [x, y, z]"}},
    {"SphereAsList",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": [0,0,5,1], "solid": true})",
     {"inputs.sphere is [0,0,5,1]", "an object with center, radius"}},
    {"Direction",
     R"({"point": [0,0,0], "direction": [0,0,1], "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.direction is unknown: it must be point, velocity, sphere, solid", "did you mean velocity?"}},
    {"Ray",
     R"({"ray": {"origin": [0,0,0], "direction": [0,0,1]}, "sphere": {"center": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.ray is unknown", "a ray is a point and a velocity"}},
    {"MistypedMember",
     R"({"point": [0,0,0], "velocity": [0,0,1], "sphere": {"centre": [0,0,5], "radius": 1}, "solid": true})",
     {"inputs.sphere.centre is unknown: it must be center, radius", "did you mean center?"}},
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

// What people write who know another library.

TEST(NearNames, OfQueriesAreThoseWithTheSameMeaning) {
  const std::pair<const char*, const char*> meant[] = {{"ray_triangle", "moving_point_triangle"},
                                                       {"rayTriangle", "moving_point_triangle"},
                                                       {"raycast-sphere", "moving_point_sphere"},
                                                       {"ray_aabb", "ray_aabox"},
                                                       {"ray_box", "moving_point_box"},
                                                       {"swept_sphere_triangle", "moving_sphere_triangle"},
                                                       {"sphere_obb_intersect", "sphere_box_overlap"},
                                                       {"obb_obb_intersection", "box_box_overlap"},
                                                       {"sphere_sphere", "sphere_sphere_overlap"},
                                                       {"box_box_depth", "box_box_penetration"},
                                                       {"closest_point_on_segment", "closest_point_segment"},
                                                       {"moving_spere_box", "moving_sphere_box"},
                                                       {"sphere_box_penetratoin", "sphere_box_penetration"}};
  for (const auto& [name, query] : meant) {
    const std::vector<std::string> near = nearest_queries(name);
    EXPECT_NE(std::find(near.begin(), near.end(), query), near.end()) << name << ": " << testing::PrintToString(near);
  }
  EXPECT_TRUE(nearest_queries("juggling").empty());
}

std::string box_case(const std::string& box) {
  return R"({"query": "moving_point_box", "scalar": "float", "inputs": {"point": [-4, 0, 0], "velocity": [1, 0, 0], "box": )" +
         box + "}}";
}

TEST(NearNames, OfFieldsSayHowToGiveThem) {
  expect_refused(box_case(R"({"min": [0,0,0], "max": [1,1,1]})"),
                 {"inputs.box.max is unknown: it must be center, half, orientation",
                  "a box has the center (min + max) / 2 and the half extents (max - min) / 2"});
  expect_refused(box_case(R"({"center": [0,0,0], "half": [1,1,1], "rotation": [0,0,0,1]})"),
                 {"inputs.box.rotation is unknown", "did you mean orientation?"});
  expect_refused(R"({"query": "ray_aabox", "scalar": "float", "inputs": {"ray": {"origin": [0,0,0], "dir": [1,0,0]},
                     "aabox": {"min": [0,0,0], "max": [1,1,1]}}})",
                 {"inputs.ray.dir is unknown", "did you mean direction?"});
  expect_refused(R"({"query": "ray_aabox", "scalar": "float", "inputs": {"ray": {"origin": [0,0,0],
                     "direction": [1,0,0]}, "aabox": {"center": [0,0,0], "half": [1,1,1]}}})",
                 {"inputs.aabox.center is unknown", "an aabox has min = center - half and max = center + half"});
}

TEST(Vectors, AndQuaternionsAreArraysOrObjects) {
  const Case c = from_text(box_case(R"({"center": [1,2,3], "half": [1,1,1], "orientation": [0, 0.5, 0, 1]})"));
  const Case same = from_text(box_case(
      R"({"center": {"x": 1, "y": 2, "z": 3}, "half": [1,1,1], "orientation": {"w": 1, "x": 0, "y": 0.5, "z": 0}})"));
  expect_same(c, same);
  EXPECT_EQ(c.values[13], 0.5);
  EXPECT_EQ(c.values[15], 1);
  const auto with = [](const std::string& orientation) {
    return box_case(R"({"center": [1,2,3], "half": [1,1,1], "orientation": )" + orientation + "}");
  };
  expect_refused(with("[0, 0, 1]"), {"inputs.box.orientation is [0,0,1]", "an array of 4, [x, y, z, w]"});
  // A matrix is not turned into a quaternion, because that rounds; the message has the quaternion.
  expect_refused(with("[[0, -1, 0], [1, 0, 0], [0, 0, 1]]"),
                 {"is a matrix: it must be a quaternion, [x, y, z, w]", "near [0, 0, 0.707106781, 0.707106781]"});
  expect_refused(with("[1, 0, 0, 0, -1, 0, 0, 0, -1]"), {"near [1, 0, 0, 0]"});
  expect_refused(with("[[-1, 0, 0], [0, 0, 1], [0, 1, 0]]"), {"near [0, 0.707106781, 0.707106781, 0]"});
  expect_refused(with("[[2, 0, 0], [0, 2, 0], [0, 0, 2]]"), {"is a matrix: it must be a quaternion"});
}

/// The case of a public report, in both forms: no number of it is a float.
const char* const with_members = R"({"query": "sphere_sphere_overlap", "scalar": "float", "inputs": {
    "sphere1": {"center": [-0.187414, 1.36075091, 0], "radius": 0.1},
    "sphere2": {"center": [0.3, 16777217, 0], "radius": 1}}})";
const char* const with_values = R"({"query": "sphere_sphere_overlap", "scalar": "float",
    "values": [-0.187414, 1.36075091, 0, 0.1, 0.3, 16777217, 0, 1]})";

Case read_nearest(const std::string& text) {
  return case_from_json(parse_json(text, "file.json"), "file.json", Decimals::nearest);
}

TEST(Decimals, MeanTheNearestNumberInBothForms) {
  const RoundedNumbers before = rounded_numbers();
  const Case c = read_nearest(with_members);
  EXPECT_EQ(rounded_numbers().count - before.count, 5u);
  EXPECT_EQ(rounded_numbers().most, 1) << "16777217 is read as 16777216";
  expect_same(c, read_nearest(with_values));
  EXPECT_EQ(rounded_numbers().count - before.count, 10u);
  EXPECT_EQ(c.values[0], double(-0.187414f));
  EXPECT_EQ(c.values[1], double(1.36075091f));
  EXPECT_EQ(c.values[5], 16777216);
  EXPECT_NE(rounded_numbers_text().find(" decimals of case files are no floats"), std::string::npos);
  expect_same(c, read_nearest(case_to_json(c).dump()));
  EXPECT_EQ(rounded_numbers().count - before.count, 10u) << "the numbers of a written case are exact";
}

TEST(Decimals, AreRefusedInBothFormsWhereACaseMustBeExact) {
  expect_refused(with_members, {"inputs.sphere1.center.x is -0.187414", "exactly a float"});
  expect_refused(with_values, {"values[0], sphere1.center.x, is -0.187414", "exactly a float"});
}

TEST(Decimals, AreRefusedWhereNoFloatIsNear) {
  for (const auto& [number, rule] : {std::pair("1e39", "within the range of float"), std::pair("1e-60", "from zero")}) {
    try {
      read_nearest(std::string(R"({"query": "sphere_sphere_overlap", "scalar": "float", "values": [)") + number +
                   ", 0, 0, 1, 0, 0, 0, 1]}");
      ADD_FAILURE() << number;
    } catch (const BadInput& e) {
      EXPECT_NE(std::string(e.what()).find(rule), std::string::npos) << e.what();
    }
  }
}

TEST(Values, MayHaveFlagsAsNumbersAndStandAlone) {
  const char* const text = R"({"query": "moving_point_sphere", "scalar": "double", "values": [0,0,0,0,0,1,0,0,5,1,%]})";
  const auto with = [&](const std::string& flag) {
    std::string t = text;
    return t.replace(t.find('%'), 1, flag);
  };
  EXPECT_EQ(from_text(with("1")).values[10], 1);
  expect_same(from_text(with("1")), from_text(with("true")));
  expect_refused(with("2"), {"values[10], solid, is 2", "true, false, 0 or 1"});
  expect_refused(with("1, 7"), {"values has 12 numbers: it must have 11"});
  expect_refused(R"({"query": "sphere_sphere_overlap", "scalar": "double", "inputs": {}, "values": []})",
                 {"values is given beside inputs"});
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
