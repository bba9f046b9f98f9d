// An answer is checked against itself before it is given.
#include "analysis/contradictions.hpp"

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
