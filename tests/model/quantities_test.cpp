// The list of quantities: each is found by its name and read from the motion that is meant.
#include "model/quantities.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string_view>

namespace gearlash::quantities_test {
namespace {

Cycle cycle(double amplitude, Stability stability) {
  Cycle one;
  one.amplitude = amplitude;
  one.period = 2.0 * amplitude;
  one.stability = stability;
  return one;
}

TEST(Quantities, EachIsFoundByItsNameAlone) {
  std::set<std::string_view> names;
  for (const QuantityInfo& info : quantities()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(find_quantity(info.name), info.quantity);
    EXPECT_FALSE(info.meaning.empty()) << info.name;
    EXPECT_EQ(info.unit.empty(), info.kind == QuantityKind::choice) << info.name;
    const Dimension* dimension = entry_of(info.quantity).dimension;
    if (dimension != nullptr && info.unit != "Hz") {
      EXPECT_EQ(dimension->unit, info.unit) << info.name;
    }
  }
  EXPECT_EQ(find_quantity("growth-at-rest"), Quantity::growth_at_rest);
  EXPECT_EQ(find_quantity("size"), Quantity::amplitude);
  EXPECT_EQ(find_quantity("width"), std::nullopt);
}

TEST(Quantities, AreThoseOfTheLargestMotionThatIsNotUnstable) {
  Answer answer;
  answer.verdict = Verdict::hunts;
  answer.cycles = {cycle(3.0, Stability::unstable), cycle(2.0, Stability::stable),
                   cycle(1.0, Stability::stable)};
  EXPECT_EQ(answer.value(Quantity::amplitude), 2.0);
  EXPECT_EQ(answer.value(Quantity::frequency), 0.25);
  EXPECT_EQ(answer.value(Quantity::impact_loss), std::nullopt);
  answer.cycles.resize(1);
  EXPECT_EQ(answer.value(Quantity::amplitude), std::nullopt);
  answer.irregular.resize(1);
  answer.irregular[0].amplitude = 7.0;
  EXPECT_EQ(answer.value(Quantity::amplitude), 7.0);
  EXPECT_EQ(answer.value(Quantity::period), std::nullopt);
}

TEST(Quantities, AmplitudesAreZeroOfWhatComesToRestAndUnknownOfWhatIsUndecided) {
  Answer answer;
  EXPECT_EQ(answer.value(Quantity::amplitude), std::nullopt);
  answer.verdict = Verdict::cannot_hunt;
  EXPECT_EQ(answer.value(Quantity::amplitude), 0.0);
  EXPECT_EQ(answer.value(Quantity::period), std::nullopt);
  answer.verdict = Verdict::comes_to_rest;
  answer.rest = Rest{};
  answer.rest->error = {-0.3, 0.1};
  EXPECT_EQ(answer.value(Quantity::static_error), 0.3);
}

/// Of the starts that are displaced least; running away is infinite, undecided is unknown.
TEST(Quantities, ErrorsAreThoseOfWhereStartsLead) {
  Answer answer;
  answer.verdict = Verdict::hunts_if_disturbed;
  answer.rest = Rest{.error = {-0.3, 0.1}};
  answer.cycles = {cycle(2.0, Stability::stable)};
  answer.cycles[0].error = 2.5;
  answer.search = SearchRecord{.reference = 1.0,
                               .starts = {{.load_position = 1.1, .end = "rest"},
                                          {.load_position = 0.9, .end = "rest"},
                                          {.load_position = 4.0, .end = "cycle", .which = 0},
                                          {.load_position = 1.0, .end = "diverges"}}};
  EXPECT_EQ(answer.value(Quantity::error), 0.3);
  EXPECT_EQ(answer.value(Quantity::error_if_disturbed), std::numeric_limits<double>::infinity());
  answer.search->starts.pop_back();
  EXPECT_EQ(answer.value(Quantity::error_if_disturbed), 2.5);
  answer.search->starts[1] = {.load_position = 0.9, .end = "cycle", .which = 0};
  EXPECT_EQ(answer.value(Quantity::error), 2.5);
  answer.search->starts[1] = {.load_position = 0.9, .end = "undecided"};
  EXPECT_EQ(answer.value(Quantity::error), std::nullopt);
  EXPECT_EQ(answer.value(Quantity::error_if_disturbed), std::nullopt);
  answer.search.reset();  // in closed form
  EXPECT_EQ(answer.value(Quantity::error), 0.3);
  EXPECT_EQ(answer.value(Quantity::error_if_disturbed), 2.5);
}

}  // namespace
}  // namespace gearlash::quantities_test
