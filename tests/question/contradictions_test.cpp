// An answer is checked against itself before it is given.
#include "question/contradictions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gearlash::contradictions_test {
namespace {

/// Every end within a ceiling of 1 rad.
Answer sound_answer() {
  Answer answer;
  answer.ceiling = Ceiling{};
  answer.ceiling->load = 1.0;
  answer.cycles.emplace_back().amplitude = 1.0;
  answer.irregular.emplace_back().amplitude = 0.9;
  answer.rest = Rest{.load = {-0.5, 1.5}};  // about a load torque's deflection
  answer.search = SearchRecord{};
  answer.search->starts = {{.end = "rest"},
                           {.end = "cycle", .which = 0},
                           {.end = "irregular", .which = 0},
                           {.end = "diverges"},
                           {.end = "undecided"}};
  return answer;
}

TEST(Contradictions, AreNoneInASoundAnswer) {
  EXPECT_TRUE(contradictions(sound_answer()).empty());
  EXPECT_TRUE(contradictions({}).empty());
}

TEST(Contradictions, AreMotionsAndRestBeyondTheCeiling) {
  Answer answer = sound_answer();
  answer.cycles[0].amplitude = 1.00001;
  answer.irregular[0].amplitude = 1.1;
  answer.rest->load.high = 1.6;
  const std::vector<std::string> all = contradictions(answer);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0], "A cycle has ±1.00001 rad, beyond the proved ceiling of ±1 rad.");
  EXPECT_EQ(all[1],
            "Motion that does not repeat has ±1.1 rad, beyond the proved ceiling of ±1 rad.");
  EXPECT_EQ(all[2], "Rest extends over ±1.05 rad, beyond the proved ceiling of ±1 rad.");
  answer.ceiling->is_below_limit = true;  // it does not bound motion that meets the torque limit
  EXPECT_TRUE(contradictions(answer).empty());
}

TEST(Contradictions, AreEndsThatAreNotListed) {
  for (const StartOutcome& start : {StartOutcome{.end = "rest"},
                                    {.end = "cycle", .which = 0},
                                    {.end = "cycle"},
                                    {.end = "irregular", .which = 0}}) {
    Answer answer = sound_answer();
    answer.rest.reset();
    answer.cycles.clear();
    answer.irregular.clear();
    answer.search->starts = {start};
    EXPECT_EQ(contradictions(answer).size(), 1U) << start.end;
  }
}

/// Equilibria of two kinds, in neither of which the motor leaves the gap of 0.2 rad.
Answer answer_with_rest_at(const RestPlace& place) {
  Answer answer = sound_answer();
  answer.rest->pieces = {{.load = {-0.5, 0.5}, .motor = {-0.6, 0.6}},
                         {RestKind::torque_limit, 1.0, {1.4, 1.5}, {1.3, 1.6}}};
  answer.search->starts[0].rest = place;
  return answer;
}

TEST(Contradictions, AreNoneOfStartsThatRestInAPiece) {
  for (const double load : {-0.5, 0.0, 0.5, 1.4, 1.5}) {
    const RestPlace place{.load = load, .motor = load, .uncertainty = 0.0};
    EXPECT_TRUE(contradictions(answer_with_rest_at(place)).empty()) << load;
  }
}

TEST(Contradictions, AreStartsThatRestBesideAllPieces) {
  for (const double load : {-0.501, 0.501, 1.0, 1.51}) {
    const RestPlace place{.load = load, .motor = load, .uncertainty = 0.0009};
    const std::vector<std::string> all = contradictions(answer_with_rest_at(place));
    ASSERT_EQ(all.size(), 1U) << load;
    EXPECT_THAT(all[0], testing::StartsWith("A start comes to rest with the load at "));
  }
  // The load in the one piece, the motor in the other.
  const RestPlace mixed{.load = 0.5, .motor = 1.3, .uncertainty = 0.0};
  EXPECT_EQ(contradictions(answer_with_rest_at(mixed)).size(), 1U);
}

TEST(Contradictions, AllowForWhatAnApproachStillLacks) {
  EXPECT_TRUE(contradictions(answer_with_rest_at({.load = 0.55, .uncertainty = 0.05})).empty());
  EXPECT_EQ(contradictions(answer_with_rest_at({.load = 0.55, .uncertainty = 0.04})).size(), 1U);
  EXPECT_TRUE(contradictions(answer_with_rest_at({.load = 0.55})).empty());  // it creeps
  Answer searched = answer_with_rest_at({.load = 0.55, .uncertainty = 0.0});
  searched.rest->pieces.clear();
  EXPECT_TRUE(contradictions(searched).empty());
}

TEST(Contradictions, WithdrawTheVerdict) {
  Answer answer = sound_answer();
  answer.verdict = Verdict::hunts_if_disturbed;
  withdraw_if_contradictory(answer);
  EXPECT_EQ(answer.verdict, Verdict::hunts_if_disturbed);
  EXPECT_TRUE(answer.notes.empty());
  answer.rest->load = {-2.0, 2.0};
  withdraw_if_contradictory(answer);
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  ASSERT_EQ(answer.notes.size(), 1U);
  EXPECT_EQ(answer.notes[0].code, "contradiction");
  EXPECT_EQ(answer.notes[0].text,
            "The answer contradicts itself. Rest extends over ±2 rad, beyond the proved ceiling of "
            "±1 rad. Please report this drive.");
}

}  // namespace
}  // namespace gearlash::contradictions_test
