// Pictures: of the kind their ending says, well formed, the same for the same motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/units.hpp"
#include "model/reduced_drive.hpp"
#include "picture/attractor_picture.hpp"
#include "picture/curve_panel.hpp"
#include "picture/drawn_motion.hpp"
#include "picture/gnuplot.hpp"
#include "picture/hunting_drive.hpp"
#include "picture/motion_picture.hpp"
#include "picture/plot_making.hpp"
#include "picture/svg_reading.hpp"

namespace gearlash::picture_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Drive sample_drive(double restitution = 0.0) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3, restitution);
  drive.reference = 1.0;
  return drive;
}

MotionPicture picture_of(const Drive& drive, double until) {
  MotionPicture picture{.title = "title", .drive = drive, .period = 2.0 * std::numbers::pi};
  picture.motions.push_back({.motion = simulate(drive, {.until = until})});
  return picture;
}

MotionPicture sample_picture(double restitution = 0.0) {
  return picture_of(sample_drive(restitution), 20.0);
}

/// A drive of the general engine, with friction and a torque limit.
Drive general_drive() {
  Drive drive = test::hunting_drive();
  drive.motor.friction.coulomb = 0.01;
  drive.motor.limit = 2.0;
  drive.reference = StepSignal{.before = 0.0, .after = 1.0, .time = 2.0};
  return drive;
}

/// Every element of an XML text is closed in order. No more is asked of the text than gnuplot does.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  std::size_t place = 0;
  while ((place = xml.find('<', place)) != std::string::npos) {
    const bool is_comment = xml.compare(place, 4, "<!--") == 0;
    const std::size_t end = is_comment ? xml.find("-->", place) : xml.find('>', place);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(place + 1, end - place - 1);
    place = end;
    if (tag.empty()) return false;
    if (is_comment || tag[0] == '?' || tag[0] == '!' || tag.back() == '/') continue;
    const std::string name =
        tag.substr(tag[0] == '/' ? 1 : 0, tag.find_first_of(" \t\r\n") - (tag[0] == '/' ? 1U : 0U));
    if (tag[0] != '/') {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty() && xml.find("<svg") != std::string::npos;
}

using test::visible_text;

constexpr Plot (*plots_of_motion[])(const MotionPicture&) = {&time_plot, &phase_plot};

TEST(Picture, KindIsThatOfTheEnding) {
  const MotionPicture picture = sample_picture();
  for (Plot (*const plot_of_motion)(const MotionPicture&) : plots_of_motion) {
    EXPECT_TRUE(is_well_formed(draw(plot_of_motion(picture), PictureFormat::svg)));
    EXPECT_THAT(draw(plot_of_motion(picture), PictureFormat::png), StartsWith("\x89PNG\r\n\x1a\n"));
    const std::string pdf = draw(plot_of_motion(picture), PictureFormat::pdf);
    EXPECT_THAT(pdf, StartsWith("%PDF-"));
    EXPECT_THAT(pdf.substr(pdf.size() - 8), HasSubstr("%%EOF"));
  }
}

TEST(Picture, EndingsAreThreeInSmallOrCapitalLetters) {
  EXPECT_EQ(picture_format("--plot", "a.svg"), PictureFormat::svg);
  EXPECT_EQ(picture_format("--plot", "a.b.PNG"), PictureFormat::png);
  EXPECT_EQ(picture_format("--plot", "dir.svg/a.Pdf"), PictureFormat::pdf);
  for (const char* name : {"a", "a.eps", "svg", ".svg", "a.svg.gz", ""}) {
    EXPECT_THROW(picture_format("--plot", name), InvalidInput) << name;
  }
}

TEST(Picture, SameMotionGivesTheSameBytes) {
  for (const double restitution : {0.0, 0.6}) {
    const MotionPicture picture = sample_picture(restitution);
    EXPECT_EQ(draw(time_plot(picture), PictureFormat::svg),
              draw(time_plot(picture), PictureFormat::svg));
    EXPECT_EQ(draw(phase_plot(picture), PictureFormat::svg),
              draw(phase_plot(picture), PictureFormat::svg));
  }
}

TEST(Picture, LegendNamesWhatIsDrawn) {
  MotionPicture picture = sample_picture();
  const std::string response = visible_text(draw(time_plot(picture), PictureFormat::svg));
  for (const char* word : {"load", "motor", "reference", "gap", "faces apart", "impact", "time (1/",
                           "position (rad)", "damping 0.19"}) {
    EXPECT_THAT(response, HasSubstr(word));
  }
  picture.motions.front().name = "on its way";
  picture.motions.front().role = MotionRole::background;
  picture.motions.push_back(
      {.motion = simulate(picture.drive, {.until = 6.4}), .name = "limit cycle", .is_cycle = true});
  const std::string plane = visible_text(draw(phase_plot(picture), PictureFormat::svg));
  for (const char* word :
       {"load, on its way", "load, limit cycle", "motor, limit cycle", "faces apart", "impact",
        "position from the reference (rad)", "damping 0.19", "backlash"}) {
    EXPECT_THAT(plane, HasSubstr(word));
  }
}

TEST(Picture, AxesAreInTheUnitOfTheBacklashAndInSeconds) {
  MotionPicture picture = sample_picture();
  picture.drive.servo->natural_frequency = 14.5;
  picture.drive.angle_unit = {.name = "arcmin", .radians = 2.908882086657216e-4};
  EXPECT_THAT(visible_text(draw(time_plot(picture), PictureFormat::svg)),
              testing::AllOf(HasSubstr("time (s)"), HasSubstr("position (arcmin)"),
                             HasSubstr("gap (arcmin)"), HasSubstr("torque (N m)")));
  EXPECT_THAT(visible_text(draw(phase_plot(picture), PictureFormat::svg)),
              HasSubstr("speed (arcmin/s)"));
}

/// Of either engine, and with what the eye looks for first.
TEST(Picture, ResponsesHaveGapTorqueLimitAndTheirLastSwing) {
  const MotionPicture picture = picture_of(general_drive(), 20.0);
  ASSERT_EQ(picture.motions.front().motion.engine(), Engine::general);
  EXPECT_THAT(
      visible_text(draw(time_plot(picture), PictureFormat::svg)),
      testing::AllOf(HasSubstr("gap (rad)"), HasSubstr("torque (N m)"),
                     HasSubstr("its limit, ±2 N m"), HasSubstr("faces apart"),
                     HasSubstr("in the last third: load ±"), HasSubstr("sensor on the load")));
}

/// Two points at the time of the leap, and none on the way.
TEST(Picture, ALeapOfTheReferenceIsVertical) {
  const MotionPicture picture = picture_of(general_drive(), 20.0);
  const std::vector<DrawnPiece> pieces =
      drawn_motion(picture.motions.front().motion, {}, picture.period, {2.0});
  std::vector<DrawnPoint> points;
  for (const DrawnPiece& piece : pieces) {
    points.insert(points.end(), piece.points.begin(), piece.points.end());
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].reference == points[i - 1].reference) continue;
    EXPECT_NEAR(points[i].time, 2.0, 1e-12);
    EXPECT_NEAR(points[i - 1].time, 2.0, 1e-12);
  }
  EXPECT_EQ(points.front().reference, 0.0);
  EXPECT_EQ(points.back().reference, 1.0);
}

TEST(Picture, TheLegendTellsCyclesAndTheirShaftsApart) {
  Drive drive = test::hunting_drive();
  drive.motor.limit = 2.0;
  const drive::ReducedDrive reduced = reduce(drive);
  drive::AttractorSearch search = drive::find_attractors(reduced);
  ASSERT_EQ(search.cycles.size(), 1U);
  search.cycles.push_back(search.cycles.front());
  search.cycles.back().amplitude *= 2.0;
  const drive::FoundCycle& cycle = search.cycles.front();
  const MotionPicture picture = attractor_picture("title", drive, reduced, search);
  ASSERT_EQ(picture.motions.size(), 2U);
  const DrawnMotion& first = picture.motions[0];
  const DrawnMotion& second = picture.motions[1];
  EXPECT_NE(first.name, second.name);
  EXPECT_THAT(first.name, testing::MatchesRegex("stable cycle ±.* rad, .* s"));
  const auto swing = [](double amplitude) {
    return "cycle ±" + angle_text(amplitude, {}, 3) + ",";
  };
  ASSERT_NE(swing(cycle.amplitude), swing(cycle.motor_amplitude));
  EXPECT_THAT(first.name, HasSubstr(swing(cycle.amplitude)));
  EXPECT_THAT(first.name_of_motor, HasSubstr(swing(cycle.motor_amplitude)));
  EXPECT_THAT(visible_text(draw(phase_plot(picture), PictureFormat::svg)),
              testing::AllOf(HasSubstr("load, " + first.name), HasSubstr("load, " + second.name),
                             HasSubstr("motor, " + first.name_of_motor), HasSubstr("faces apart")));
}

TEST(Picture, AnSvgIsNamedByItsTitle) {
  MotionPicture picture = sample_picture();
  picture.title = "hunts: <±0.1 rad> & more";
  for (Plot (*const plot_of_motion)(const MotionPicture&) : plots_of_motion) {
    EXPECT_THAT(draw(plot_of_motion(picture), PictureFormat::svg),
                HasSubstr("<title>hunts: &lt;±0.1 rad> &amp; more</title>"));
  }
}

TEST(Picture, ALongSubtitleIsTwoLines) {
  const std::string numbers = "damping 0.18861093889995897, inertia_ratio 1.992976605137472, ";
  Panel panel;
  add_curves({{.line = {{0.0, 0.0}, {1.0, 1.0}}}}, 0.0, panel);
  const std::string svg =
      draw(plot_of("title", numbers + numbers + "friction_ratio 0.07710100231303006", panel),
           PictureFormat::svg);
  EXPECT_THAT(visible_text(svg), Not(HasSubstr(numbers + numbers + "friction")));
  EXPECT_THAT(visible_text(svg), HasSubstr("0.07710100231303006"));
}

TEST(Picture, TitleIsTextWhateverItHolds) {
  MotionPicture picture = sample_picture();
  picture.title = "it's a \"title\" {/*9 big} a_b^c @d &e ~f \\n `date` $x <g> # h";
  const std::string svg = draw(time_plot(picture), PictureFormat::svg);
  EXPECT_TRUE(is_well_formed(svg));
  const std::string text = visible_text(svg);
  EXPECT_THAT(text, HasSubstr("it's a "));
  EXPECT_THAT(text, HasSubstr("{/*9 big} a_b^c @d "));
  EXPECT_THAT(text, HasSubstr("`date` $x "));
}

TEST(Picture, DegenerateMotionsCanBeDrawn) {
  for (const double backlash : {0.0, 0.3}) {
    for (const double damping : {0.0, 0.5, 100.0}) {
      for (const double reference : {0.0, 1.0}) {
        Drive drive = normal_form(damping, 1.0, 0.5, backlash);
        drive.reference = reference;
        const MotionPicture picture = picture_of(drive, 10.0);
        EXPECT_TRUE(is_well_formed(draw(time_plot(picture), PictureFormat::svg)));
        EXPECT_TRUE(is_well_formed(draw(phase_plot(picture), PictureFormat::svg)));
      }
    }
  }
}

TEST(EdgePicture, APlaneWithoutACycleSaysSo) {
  MotionPicture picture = sample_picture();
  picture.motions.clear();
  EXPECT_THAT(visible_text(draw(phase_plot(picture), PictureFormat::svg)),
              HasSubstr("no cycle was found"));
}

TEST(EdgePicture, AChartOfNothingHasItsAxesAndSaysWhy) {
  const auto panel_of = [](double nothing, double low, bool logarithmic = false) {
    Panel panel{.x = {.name = "across", .low = 0.7, .high = 0.9},
                .y = {.name = "upwards", .logarithmic = logarithmic, .low = low}};
    add_curves({{.name = "servo: rests", .line = {{0.7, nothing}, {0.9, nothing}}}}, 0.8, panel);
    say("no limit cycle", panel);
    return panel;
  };
  for (const double low : {double{NAN}, 0.0}) {
    for (const double nothing : {NAN, INFINITY, -INFINITY}) {
      const std::string text =
          visible_text(draw(plot_of("the title", "", panel_of(nothing, low)), PictureFormat::svg));
      for (const char* word : {"the title", "across", "upwards", "no limit cycle", "0.75"}) {
        EXPECT_THAT(text, HasSubstr(word));
      }
    }
  }
  const Plot plot = plot_of("", "", panel_of(NAN, NAN, true));
  EXPECT_THAT(visible_text(draw(plot, PictureFormat::svg)), HasSubstr("servo: rests"));
  EXPECT_THAT(draw(plot, PictureFormat::png), StartsWith("\x89PNG"));
  EXPECT_THAT(draw(plot, PictureFormat::pdf), StartsWith("%PDF-"));
}

/// What stands below the x axis, from its ends given.
std::string numbers_of_axis(double low, double high, bool logarithmic) {
  const Panel panel{.x = {.logarithmic = logarithmic, .low = low, .high = high},
                    .y = {.low = 0.0, .high = 1.0},
                    .layers = {{.points = {{low, 0.0}, {high, 1.0}}}}};
  std::string text;
  for (const char c : visible_text(draw(plot_of("", "", panel), PictureFormat::svg))) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) text += c;
  }
  return text;
}

TEST(EdgePicture, NumbersOfSmallAndWideAxesArePowersOfTen) {
  const struct {
    double low;
    double high;
    bool logarithmic;
    const char* numbers;
  } cases[] = {{1e-6, 1e3, true, "10⁻⁶10⁻⁴10⁻²10⁰10²"},
               {1e-7, 1.0, true, "10⁻⁷10⁻⁶10⁻⁵10⁻⁴10⁻³10⁻²10⁻¹10⁰"},
               {2e-5, 1.0, true, "10⁻⁴10⁻³10⁻²10⁻¹10⁰"},
               {1.0, 1e7, true, "10⁰10¹10²10³10⁴10⁵10⁶10⁷"},
               {2e-5, 9e-5, true, "2·10⁻⁵5·10⁻⁵"},
               {2e-5, 2.4e-5, true, "2·10⁻⁵2.1·10⁻⁵2.2·10⁻⁵2.3·10⁻⁵2.4·10⁻⁵"},
               {1e-7, 2e-7, false, "100120140160180200"}};
  for (const auto& [low, high, logarithmic, numbers] : cases) {
    const std::string text = numbers_of_axis(low, high, logarithmic);
    EXPECT_THAT(text, HasSubstr(numbers));
    EXPECT_THAT(text, Not(HasSubstr("0.000")));
  }
  EXPECT_THAT(numbers_of_axis(1e-4, 10.0, true), HasSubstr("0.00010.001"));
}

/// gnuplot labels powers of ten alone.
TEST(EdgePicture, ALogarithmicAxisHasTwoLabelsOrMore) {
  const struct {
    double low;
    double high;
    const char* numbers;
  } cases[] = {{0.02, 0.2, "0.020.050.10.2"}, {3.0, 4.0, "33.23.43.63.84"}, {0.5, 6.0, "0.5125"}};
  for (const auto& [low, high, numbers] : cases) {
    EXPECT_THAT(numbers_of_axis(low, high, true), HasSubstr(numbers));
  }
  const Panel panel{.x = {.logarithmic = true},
                    .y = {.low = 0.0, .high = 1.0},
                    .layers = {{.points = {{0.02, 0.0}, {0.2, 1.0}}}}};
  EXPECT_THAT(visible_text(draw(plot_of("", "", panel), PictureFormat::svg)), HasSubstr("0.05"));
}

TEST(Picture, WhatCouldNotBeReadIsRefused) {
  MotionPicture picture = picture_of(sample_drive(), 2.0 * most_periods_drawn * 6.3);
  EXPECT_THROW(time_plot(picture), InvalidInput);
}

}  // namespace
}  // namespace gearlash::picture_test
