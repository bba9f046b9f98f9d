// What a map of a grid shows: regions up to the boundary, contours, and nothing that is not known.
#include "picture/grid_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "picture/gnuplot.hpp"
#include "picture/grid_chart.hpp"
#include "picture/plot_making.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::grid_map_test {
namespace {

GridTable map_table(const Grid& grid) {
  GridTable table{.grid = grid, .table = worked_out(grid), .provenance = {}};
  table.hunting_boundary = hunting_boundary(grid, table.table[Quantity::growth_at_rest]);
  return table;
}

GridTable map_table(double restitution) {
  return map_table({drive_of({.inertia_ratio = 2.0, .backlash = 1.0, .restitution = restitution}),
                    {spaced_axis("y", "servo.damping", 0.1, 0.9, 13, Spacing::logarithmic),
                     spaced_axis("x", "servo.friction_ratio", 0.05, 0.95, 17, Spacing::linear)}});
}

/// A place in shares of the axes.
struct Place {
  double along;
  double up;
};

Place place_of(const Grid& grid, const MapPoint& point) {
  return {position_on(grid.axes[1], point.x), position_on(grid.axes[0], point.y)};
}

double distance(const Place& point, const Place& from, const Place& to) {
  const double along = to.along - from.along;
  const double up = to.up - from.up;
  const double way = (point.along - from.along) * along + (point.up - from.up) * up;
  const double share = std::clamp(way / (along * along + up * up), 0.0, 1.0);
  return std::hypot(point.along - from.along - share * along, point.up - from.up - share * up);
}

double distance(const Grid& grid, const MapPoint& point, const std::vector<MapCurve>& curves) {
  double nearest = INFINITY;
  for (const MapCurve& curve : curves) {
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      nearest = std::min(nearest, distance(place_of(grid, point), place_of(grid, curve[i]),
                                           place_of(grid, curve[i + 1])));
    }
  }
  return nearest;
}

bool is_at_edge(const Grid& grid, const MapPoint& point) {
  const Place place = place_of(grid, point);
  return std::min({place.along, 1.0 - place.along, place.up, 1.0 - place.up}) < 1e-9;
}

const Panel& panel_of(const Plot& plot) { return plot.columns.at(0).at(0); }

bool has_layer(const Plot& plot, const std::string& name) {
  const std::vector<Layer>& layers = panel_of(plot).layers;
  return std::any_of(layers.begin(), layers.end(),
                     [&](const Layer& layer) { return layer.name == name; });
}

/// The lines of all layers of that name.
std::vector<MapCurve> curves_of(const Plot& plot, const std::string& name) {
  std::vector<MapCurve> curves;
  for (const Layer& layer : panel_of(plot).layers) {
    if (layer.name != name) continue;
    curves.emplace_back();
    for (const MapPoint& point : layer.points) {
      if (std::isnan(point.x)) {
        curves.emplace_back();
      } else {
        curves.back().push_back(point);
      }
    }
  }
  return curves;
}

bool contains(const Grid& grid, const MapCurve& outline, const MapPoint& point) {
  const Place place = place_of(grid, point);
  bool is_inside = false;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Place from = place_of(grid, outline[i]);
    const Place to = place_of(grid, outline[i + 1]);
    if ((from.up > place.up) == (to.up > place.up)) continue;
    const double share = (place.up - from.up) / (to.up - from.up);
    if (from.along + share * (to.along - from.along) > place.along) is_inside = !is_inside;
  }
  return is_inside;
}

/// The region that is seen at a point: what is drawn last covers the others.
std::string region_at(const Plot& plot, const Grid& grid, const MapPoint& point) {
  std::string seen;
  for (const Layer& layer : panel_of(plot).layers) {
    if (layer.kind == LayerKind::area && contains(grid, layer.points, point)) seen = layer.name;
  }
  return seen;
}

std::vector<MapCurve> rest_of(const Plot& plot) { return curves_of(plot, "comes to rest"); }

TEST(GridMap, RestEndsAtTheBoundary) {
  const GridTable table = map_table(0.0);
  const std::vector<MapCurve> rest = rest_of(map_plot(table, Quantity::amplitude));
  ASSERT_EQ(rest.size(), 1U);
  ASSERT_GT(rest.front().size(), 10U);
  for (const MapPoint& point : rest.front()) {
    EXPECT_TRUE(is_at_edge(table.grid, point) ||
                distance(table.grid, point, *table.hunting_boundary) <
                    picture_accuracy.straightness)
        << point.x << ", " << point.y;
  }
}

TEST(GridMap, RegionsAreThoseOfTheVerdicts) {
  const GridTable table = map_table(0.0);
  const Plot map = map_plot(table, Quantity::amplitude);
  std::size_t resting = 0;
  for (std::size_t row = 0; row < table.grid.size(); ++row) {
    const NormalizedServo servo = servo_of(table.grid.at(row));
    const MapPoint point{servo.friction_ratio, servo.damping};
    if (is_at_edge(table.grid, point)) continue;
    const bool has_cycle = table.table.verdict(row) == Verdict::hunts;
    EXPECT_EQ(region_at(map, table.grid, point), has_cycle ? "hunts" : "comes to rest")
        << point.x << ", " << point.y;
    resting += has_cycle ? 0U : 1U;
  }
  EXPECT_GT(resting, 10U);
}

TEST(GridMap, APointThatMayHuntOrIsNotKnownHasARegion) {
  for (const bool known : {true, false}) {
    GridTable table = map_table(0.0);
    const std::size_t row = 11 * 17 + 8;
    ASSERT_EQ(table.table.verdict(row), Verdict::cannot_hunt);
    table.table.column_of_verdicts()[row] =
        known ? Verdict::hunts_if_disturbed : Verdict::undecided;
    EXPECT_TRUE(has_layer(map_plot(table, Quantity::amplitude),
                          known ? "hunts if disturbed" : "not known"));
  }
}

TEST(EdgeGridMap, RestSmallerThanACellIsMissed) {
  // Friction on one side only hunts, at either end: the quiet servos between are missed altogether.
  const Grid grid{drive_of({.inertia_ratio = 2.0, .backlash = 1.0}),
                  {{"servo.damping", {0.5, 1.0}}, {"servo.friction_ratio", {0.0, 1.0}}}};
  const GridTable table = map_table(grid);
  EXPECT_TRUE(table.hunting_boundary->empty());
  EXPECT_TRUE(rest_of(map_plot(table, Quantity::amplitude)).empty());
}

TEST(GridMap, TheBoundaryIsNoContour) {
  const GridTable table = map_table(0.0);
  const Plot map = map_plot(table, Quantity::growth_at_rest);
  EXPECT_GE(panel_of(map).texts.size(), 5U);
  for (const PlotText& number : panel_of(map).texts) EXPECT_NE(number.text, "1");
}

/// Levels are round in the author's unit; curves and axes are in it.
TEST(GridMap, IsDrawnInTheUnitOfAngles) {
  constexpr double arcminute = 1e-3;
  GridTable table =
      map_table({drive_of({.inertia_ratio = 2.0, .friction_ratio = 0.3}),
                 {spaced_axis("y", "servo.damping", 0.1, 0.4, 5, Spacing::logarithmic),
                  spaced_axis("x", "servo.backlash", 1e-3, 2e-3, 5, Spacing::linear)}});
  const Plot radians = map_plot(table, Quantity::amplitude);
  table.grid.drive.angle_unit = {"arcmin", arcminute};
  const Plot map = map_plot(table, Quantity::amplitude);
  EXPECT_EQ(map.title, "Amplitude of the load (arcmin)");
  const Panel& panel = panel_of(map);
  EXPECT_EQ(panel.x.label, "backlash (arcmin)");
  EXPECT_DOUBLE_EQ(panel.x.low, 1.0);
  EXPECT_DOUBLE_EQ(panel.x.high, 2.0);
  EXPECT_DOUBLE_EQ(panel.y.low, 0.1);
  const Panel& other = panel_of(radians);
  ASSERT_EQ(panel.layers.size(), other.layers.size());
  ASSERT_EQ(panel.texts.size(), other.texts.size());
  ASSERT_GE(panel.texts.size(), 2U);
  for (std::size_t i = 0; i < panel.texts.size(); ++i) {
    EXPECT_NEAR(std::stod(panel.texts[i].text), std::stod(other.texts[i].text) / arcminute, 1e-9);
  }
  for (std::size_t i = 0; i < panel.layers.size(); ++i) {
    ASSERT_EQ(panel.layers[i].points.empty(), other.layers[i].points.empty());
    if (panel.layers[i].points.empty()) continue;
    const MapPoint& in_radians = other.layers[i].points.front();
    EXPECT_NEAR(panel.layers[i].points.front().x, in_radians.x / arcminute, 1e-6);
    EXPECT_NEAR(panel.layers[i].points.front().y, in_radians.y, 1e-9);
  }
}

TEST(GridChart, IsDrawnInTheUnitOfAngles) {
  const Grid grid{drive_of({.damping = 0.1, .inertia_ratio = 2.0, .friction_ratio = 0.3}),
                  {spaced_axis("x", "servo.backlash", 1e-3, 2e-3, 3, Spacing::linear)}};
  GridTable table{.grid = grid, .table = worked_out(grid), .provenance = {}};
  const Plot radians = chart_plot(table, Quantity::amplitude);
  const MapPoint in_radians = panel_of(radians).layers.at(0).points.at(1);
  table.grid.drive.angle_unit = {"arcmin", 1e-3};
  const Plot chart = chart_plot(table, Quantity::amplitude);
  EXPECT_EQ(panel_of(chart).y.label, "amplitude (arcmin)");
  const MapPoint point = panel_of(chart).layers.at(0).points.at(1);
  EXPECT_DOUBLE_EQ(point.x, 1e3 * in_radians.x);
  EXPECT_DOUBLE_EQ(point.y, 1e3 * in_radians.y);
}

TEST(GridMap, ItsPictureIsTheSameEachTimeAndHasItsNumbers) {
  const Plot map = map_plot(map_table(0.0), Quantity::amplitude);
  const std::string svg = draw(map, PictureFormat::svg);
  EXPECT_EQ(svg, draw(map, PictureFormat::svg));
  EXPECT_GE(panel_of(map).texts.size(), 5U);
  for (const PlotText& number : panel_of(map).texts) {
    EXPECT_NE(svg.find(">" + number.text + "<"), std::string::npos) << number.text;
  }
}

/// The limit of a target on the amplitude is where the amplitude has it.
TEST(OracleGridMap, ShadesWhereATargetIsMet) {
  GridTable table = map_table(0.0);
  constexpr double limit = 0.4;
  table.target = Target{}.require(Quantity::amplitude, {0.0, limit});
  table.target_text = "amplitude <= 0.4";
  table.present = MapPoint{0.5, 0.3};
  work_out(table);
  add_borders(table);
  const Plot map = map_plot(table, Quantity::amplitude);
  EXPECT_EQ(map.title, "Target: amplitude <= 0.4");
  EXPECT_FALSE(curves_of(map, "met").empty());
  EXPECT_FALSE(curves_of(map, "missed").empty());
  EXPECT_EQ(curves_of(map, "now"), std::vector<MapCurve>{{*table.present}});
  EXPECT_TRUE(has_layer(map, "hunting ends"));
  EXPECT_TRUE(rest_of(map).empty());
  const std::vector<MapCurve> limit_curves = curves_of(map, "limit");
  ASSERT_FALSE(limit_curves.empty());
  for (const MapCurve& curve : limit_curves) {
    for (const MapPoint& point : curve) {
      const Answer answer = closed_answer(drive_of(servo_at(table.grid, point)));
      EXPECT_NEAR(answer.value(Quantity::amplitude).value(), limit, 1e-5);
    }
  }
  table.target->no_hunting = true;  // its limit is where hunting ends
  EXPECT_FALSE(has_layer(map_plot(table, Quantity::amplitude), "hunting ends"));
  table.present = MapPoint{2.0, 0.3};
  EXPECT_FALSE(has_layer(map_plot(table, Quantity::amplitude), "now"));
}

TEST(EdgeGridMap, NothingKnownIsAnEmptyPicture) {
  GridTable table = map_table(0.0);
  const std::size_t rows = table.grid.size();
  table.table = table_of(rows);
  table.hunting_boundary = std::vector<MapCurve>{};
  const Plot map = map_plot(table, Quantity::amplitude);
  ASSERT_EQ(panel_of(map).layers.size(), 1U);
  EXPECT_EQ(panel_of(map).layers.front().name, "not known");
  EXPECT_NE(draw(map, PictureFormat::svg).find("damping"), std::string::npos);
}

}  // namespace
}  // namespace gearlash::grid_map_test
