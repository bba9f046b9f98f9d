// Any struct of which the build makes a list of members is written as JSON.
#include "output/json_writer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "made_up.hpp"
#include "made_up_records.hpp"

namespace gearlash::made_up {

const char* name_of(Colour colour) { return colour == Colour::red ? "red" : "dark blue"; }

}  // namespace gearlash::made_up

namespace gearlash::json_writer_test {
namespace {

TEST(JsonWriter, WritesEveryMemberUnderItsName) {
  const made_up::Cart cart{.wheel = {0.25}, .others = {{0.5}, {0.1}}};
  EXPECT_EQ(document_text(cart), R"({
  "schema": "gearlash/made-up/1",
  "units": "SI",
  "wheel": {
    "radius": 0.25,
    "width": 0.5
  },
  "others": [
    {
      "radius": 0.5,
      "width": 1
    },
    {
      "radius": 0.1,
      "width": 0.2
    }
  ],
  "mass": null,
  "colour": "dark blue",
  "name": null,
  "fastening": {
    "kind": "feather key",
    "length": 0
  },
  "limit": "inf",
  "unknown": null
}
)");
}

TEST(JsonWriter, WritesInOneLineToo) {
  EXPECT_EQ(json_of(made_up::Wheel{0.25}), R"({"radius":0.25,"width":0.5})");
  EXPECT_EQ(json_of(std::vector<double>{}), "[]");
  EXPECT_EQ(json_of(ByName<std::optional<double>>{{"a \"b\"", 1.5}, {"c", {}}}),
            R"({"a \"b\"":1.5,"c":null})");
}

TEST(JsonWriter, RowsAreWrittenAsTheyAreComputed) {
  const RowsOf<made_up::Wheel> rows{[](const auto& write) {
    for (const double radius : {1.0, 2.0}) write({radius});
  }};
  const auto json = nlohmann::json::parse(json_of(rows));
  EXPECT_EQ(json, nlohmann::json::parse(R"({"columns": ["radius"], "rows": [[1], [2]]})"));
}

TEST(EdgeJsonWriter, NumbersReadBackExactly) {
  for (const double value : {0.1, 1.0 / 3.0, 5e-324, -0.0, 1.7976931348623157e308, 1e22}) {
    EXPECT_EQ(nlohmann::json::parse(json_text(value)).get<double>(), value);
  }
  EXPECT_EQ(json_text(-std::numeric_limits<double>::infinity()), "\"-inf\"");
  EXPECT_TRUE(nlohmann::json::accept(json_text("\x01\xff\"")));
}

}  // namespace
}  // namespace gearlash::json_writer_test
