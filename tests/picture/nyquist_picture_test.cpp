// The picture of L(jω) and −1/N(A): its points lie where the numbers say.
#include "picture/nyquist_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "controllers.hpp"
#include "gearlash/units.hpp"
#include "picture/gnuplot.hpp"

namespace gearlash::nyquist_picture_test {
namespace {

using drive::DescribedPart;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

drive::ReducedDrive all_parts() {
  drive::ReducedDrive drive;
  drive.motor = {0.25, {.viscous = 0.75, .coulomb = 0.2, .breakaway = 0.3}};
  drive.load = {0.75, {.viscous = 0.25}};
  drive.backlash = 0.02;
  drive.contact = drive::CompliantContact{.stiffness = 300.0, .damping = 0.5};
  drive.controller = at_load(PID{.terms = PIDTerms::PID, .proportional = 9.0, .integral = 12.0});
  drive.torque_limit = 2.0;
  return drive;
}

NyquistPicture picture_of(const drive::ReducedDrive& drive, DescribedPart part) {
  NyquistPicture picture;
  picture.title = "title";
  picture.analyses = loop_analyses(describing_analyses(drive), part);
  return picture;
}

NyquistPicture picture_of(DescribedPart part) {
  NyquistPicture picture = picture_of(all_parts(), part);
  picture.exact = {{0.03, 0.035, 2.5}, {0.01, 0.01, 5.0, false}};
  return picture;
}

TEST(NyquistPicture, BothLoadsInTheGapShareAPicture) {
  const auto analyses = describing_analyses(all_parts());
  EXPECT_EQ(analyses.size(), 5U);
  EXPECT_EQ(loop_analyses(analyses, DescribedPart::gap_load_held).size(), 2U);
  EXPECT_EQ(loop_analyses(analyses, DescribedPart::coulomb_friction).size(), 1U);
  EXPECT_TRUE(loop_analyses({analyses[0]}, DescribedPart::torque_limit).empty());
}

TEST(NyquistPicture, EveryPartIsDrawn) {
  for (const DescribedPart part : {DescribedPart::gap_load_held, DescribedPart::elastic_gap,
                                   DescribedPart::torque_limit, DescribedPart::coulomb_friction}) {
    const NyquistPicture picture = picture_of(part);
    const std::string svg = draw(nyquist_plot(picture), PictureFormat::svg);
    EXPECT_THAT(svg, HasSubstr("L(jω)"));
    EXPECT_THAT(svg, HasSubstr("−1/N(A)"));
    EXPECT_THAT(svg, HasSubstr("L at the exact frequency: ±0.03 rad, 0.4 Hz"));
    for (const auto& analysis : picture.analyses) {
      for (const auto& cycle : analysis.cycles) {
        EXPECT_THAT(svg, HasSubstr(cycle.balance.stable ? " stable" : " unstable"));
        EXPECT_THAT(svg, HasSubstr(significant(cycle.amplitude, 3) + " rad"));
      }
    }
    EXPECT_EQ(svg, draw(nyquist_plot(picture), PictureFormat::svg));
  }
}

TEST(NyquistPicture, IsOfTheKindAskedFor) {
  const NyquistPicture picture = picture_of(DescribedPart::gap_load_held);
  EXPECT_THAT(draw(nyquist_plot(picture), PictureFormat::png), StartsWith("\x89PNG"));
  EXPECT_THAT(draw(nyquist_plot(picture), PictureFormat::pdf), StartsWith("%PDF-"));
}

struct Text {
  double x;
  double y;
  double number;
};

/// The numbers of an SVG, which are those of its axes.
std::vector<Text> numbers_of(const std::string& svg) {
  const std::regex pattern(
      R"(translate\(([-\d.]+),([-\d.]+)\)[^>]*>\s*<text>\s*(?:<[^>]*>)*\s*(-?[\d.]+)\s*<)");
  std::vector<Text> numbers;
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i) {
    numbers.push_back({std::stod((*i)[1]), std::stod((*i)[2]), std::stod((*i)[3])});
  }
  return numbers;
}

TEST(NyquistPicture, RealAndImaginaryPartsHaveTheSameScale) {
  drive::ReducedDrive drive;
  drive.motor = {0.25, {.viscous = 0.75}};
  drive.load = {0.75, {.viscous = 0.25}};
  drive.backlash = 2.0;
  drive.controller = at_load(PID{.proportional = 5.0});
  const auto numbers = numbers_of(
      draw(nyquist_plot(picture_of(drive, DescribedPart::gap_load_held)), PictureFormat::svg));
  // The imaginary axis' numbers stand at one x and come first, then the real axis' at one y.
  std::vector<Text> up;
  std::vector<Text> right;
  for (const Text& text : numbers) {
    if (text.x == numbers.front().x) up.push_back(text);
    if (!up.empty() && text.y > up.front().y + 10.0) right.push_back(text);
  }
  ASSERT_GT(up.size(), 2U);
  ASSERT_GT(right.size(), 2U);
  const double height = (up.front().y - up.back().y) / (up.back().number - up.front().number);
  const double width =
      (right.back().x - right.front().x) / (right.back().number - right.front().number);
  EXPECT_GT(height, 20.0);
  EXPECT_NEAR(width, height, 0.01 * height);
}

TEST(EdgeNyquistPicture, WithoutCycleOrExactOneThereAreTheCurves) {
  drive::ReducedDrive drive = all_parts();
  drive.controller = at_load(PID{.terms = PIDTerms::PD, .proportional = 0.5, .derivative = 2.0});
  for (const auto part : {DescribedPart::gap_load_held, DescribedPart::elastic_gap,
                          DescribedPart::torque_limit, DescribedPart::coulomb_friction}) {
    const std::string svg = draw(nyquist_plot(picture_of(drive, part)), PictureFormat::svg);
    EXPECT_THAT(svg, Not(HasSubstr("diamonds")));
    EXPECT_THAT(svg, HasSubstr("L(jω)"));
  }
}

/// The exact motor moves less than half the gap: a held load would not move at all.
TEST(EdgeNyquistPicture, AnAmplitudeWithoutGainIsSaidSo) {
  NyquistPicture picture = picture_of(DescribedPart::gap_load_held);
  picture.exact = {{0.003, 0.005, 2.5}};
  EXPECT_THAT(draw(nyquist_plot(picture), PictureFormat::svg),
              HasSubstr("−1/N at the exact amplitude, held: none, too small"));
}

}  // namespace
}  // namespace gearlash::nyquist_picture_test
