// Bifurcation pictures: branches, marks of borders, units, and axes.
#include "picture/bifurcation_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "picture/gnuplot.hpp"
#include "picture/hunting_drive.hpp"
#include "picture/svg_reading.hpp"

namespace gearlash::bifurcation_picture_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

CycleAt at(double parameter, double amplitude) {
  return {.parameter = parameter,
          .amplitude = amplitude,
          .motor_amplitude = 2.0 * amplitude,
          .period = 0.5};
}

BifurcationDiagram diagram_with_fold() {
  BifurcationDiagram diagram;
  diagram.branches = {
      {.stability = Stability::stable, .points = {at(2.0, 0.2), at(3.0, 0.3), at(4.0, 0.35)}},
      {.stability = Stability::unstable, .points = {at(2.0, 0.2), at(3.0, 0.1)}}};
  diagram.borders = {{.parameter = 2.0, .word = "fold", .cycle = at(2.0, 0.2)},
                     {.parameter = 3.0, .word = "something new", .cycle = at(3.0, 0.1)},
                     {.parameter = 3.5, .word = "border of running away", .cycle = {}}};
  diagram.rests = {{1.0, 3.0}};
  return diagram;
}

Grid grid_of(const char* path, double high = 4.0) {
  return {.drive = test::hunting_drive(), .axes = {linear(path, 1.0, high, 7)}};
}

TEST(BifurcationPicture, EachThingHasOneName) {
  const std::string svg =
      draw(bifurcation_plot(diagram_with_fold(), grid_of("controller.proportional"),
                            Quantity::amplitude),
           PictureFormat::svg);
  for (const char* name : {"stable cycle", "unstable cycle", "can come to rest", "fold",
                           "something new", "border of running away"}) {
    EXPECT_EQ(test::count_of(">" + std::string(name) + "</tspan>", svg), 1U) << name;
  }
  EXPECT_THAT(svg, AllOf(HasSubstr("amplitude (rad)"), HasSubstr("controller proportional"),
                         Not(HasSubstr("closes no cycle"))));
}

TEST(BifurcationPicture, AnglesAreInTheUnitOfTheUser) {
  Grid grid = grid_of("gearbox.backlash");
  grid.drive.angle_unit = {.name = "deg", .radians = 0.017453292519943295};
  const std::string svg =
      draw(bifurcation_plot(diagram_with_fold(), grid, Quantity::amplitude), PictureFormat::svg);
  EXPECT_THAT(svg, AllOf(HasSubstr("amplitude (deg)"), HasSubstr("gearbox backlash (deg)"),
                         HasSubstr(">20<"), HasSubstr(">200<"), Not(HasSubstr("(rad)"))));
}

TEST(BifurcationPicture, WideAmplitudesAreLogarithmicWithRestAtTheFoot) {
  BifurcationDiagram diagram = diagram_with_fold();
  diagram.irregular = {{.parameter = 1.5, .amplitude = 1e-4, .motor_amplitude = 1e-4}};
  const std::string svg =
      draw(bifurcation_plot(diagram, grid_of("controller.proportional"), Quantity::amplitude),
           PictureFormat::svg);
  EXPECT_THAT(svg, AllOf(HasSubstr("10⁻⁴<"), HasSubstr("can come to rest"),
                         HasSubstr("motion that closes no cycle")));
}

TEST(BifurcationPicture, PeriodsHaveNeitherRestNorIrregularMotion) {
  BifurcationDiagram diagram = diagram_with_fold();
  diagram.irregular = {{.parameter = 1.5, .amplitude = 0.1, .motor_amplitude = 0.1}};
  const std::string svg =
      draw(bifurcation_plot(diagram, grid_of("controller.proportional"), Quantity::period),
           PictureFormat::svg);
  EXPECT_THAT(svg, AllOf(HasSubstr("period (s)"), HasSubstr("stable cycle"),
                         Not(HasSubstr("can come to rest")), Not(HasSubstr("closes no cycle"))));
  EXPECT_TRUE(faults_of_branches(grid_of("controller.proportional"), Quantity::period).empty());
  EXPECT_EQ(faults_of_branches(grid_of("controller.proportional"), Quantity::growth_at_rest).size(),
            1U);
}

TEST(BifurcationPicture, NothingSaysSo) {
  EXPECT_THAT(draw(bifurcation_plot({}, grid_of("controller.proportional"), Quantity::amplitude),
                   PictureFormat::svg),
              HasSubstr("no cycle was found"));
}

}  // namespace
}  // namespace gearlash::bifurcation_picture_test
