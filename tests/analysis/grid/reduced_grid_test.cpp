// What is kept of a grid, against the whole table, for any division into pieces.
#include "analysis/grid/reduced_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "analysis/grid/grid_pieces.hpp"
#include "analysis/grid/servo_grids.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::reduced_grid_test {
namespace {

constexpr Kept everything = {
    .counts = true, .extremes = true, .histograms = true, .quantiles = true, .border = true};
const std::vector<Quantity> two_quantities = {Quantity::growth_at_rest, Quantity::amplitude};

Axis axis_of(const char* path, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(0.1 + 0.01 * static_cast<double>(i));
  return {.path = path, .values = values};
}

Grid grid_of(const std::vector<std::size_t>& counts) {
  constexpr const char* paths[] = {"servo.damping", "servo.inertia_ratio", "servo.friction_ratio"};
  Grid grid{.drive = normal_form(0.5, 1.0, 0.5)};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    grid.axes.push_back(axis_of(paths[i], counts[i]));
  }
  return grid;
}

/// Patches of verdicts with specks in them, and values with ties, gaps and infinities.
Table random_table(const Grid& grid, SeededDraws& draws) {
  Table table(grid.size(), two_quantities);
  Verdict verdict = Verdict::hunts;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (draws.happens(0.1)) {
      verdict = static_cast<Verdict>(static_cast<int>(draws.uniform(0.0, 3.999)));
    }
    table.column_of_verdicts()[row] = verdict;
    for (const Quantity quantity : two_quantities) {
      const double value = std::round(draws.either_sign(0.01, 100.0) * 10.0) / 10.0;
      const double special = draws.one_of({not_a_number, infinity, 0.0});
      table.column(quantity)[row] = draws.happens(0.2) ? special : value;
    }
  }
  return table;
}

/// In boxes of the grid of at most `longest` points, some kept and gone on with as text.
ReducedGrid reduced_in_pieces(const Grid& grid, const Table& table, std::size_t longest,
                              std::size_t packed_every) {
  ReducedGrid reduced(grid, two_quantities, everything);
  std::size_t pieces = 0;
  for (std::size_t first = 0; first < grid.size();) {
    Table piece(box_length(grid, first, longest), two_quantities);
    for (std::size_t row = 0; row < piece.rows(); ++row) {
      piece.column_of_verdicts()[row] = table.verdict(first + row);
      for (const Quantity quantity : two_quantities) {
        piece.column(quantity)[row] = table[quantity][first + row];
      }
    }
    reduced.add(piece);
    first += piece.rows();
    if (++pieces % packed_every != 0) continue;
    ReducedGrid again(grid, two_quantities, everything);
    EXPECT_TRUE(again.unpack(reduced.packed()));
    reduced = again;
  }
  return reduced;
}

/// By the definition: each point against each neighbor.
std::vector<BorderPoint> border_of(const Grid& grid, const Table& table) {
  std::vector<BorderPoint> border;
  for (std::size_t point = 0; point < grid.size(); ++point) {
    std::size_t stride = grid.size();
    bool differs = false;
    for (const Axis& axis : grid.axes) {
      stride /= axis.values.size();
      const std::size_t place = point / stride % axis.values.size();
      if (place > 0) differs |= table.verdict(point) != table.verdict(point - stride);
      if (place + 1 < axis.values.size()) {
        differs |= table.verdict(point) != table.verdict(point + stride);
      }
    }
    if (differs) border.push_back({point, table.verdict(point)});
  }
  return border;
}

void expect_kept(const Grid& grid, const Table& table, ReducedGrid& reduced) {
  ASSERT_EQ(reduced.points(), grid.size());
  EXPECT_EQ(reduced.border(), border_of(grid, table));
  std::map<std::pair<std::size_t, double>, VerdictCounts> by_value;
  VerdictCounts all{};
  for (std::size_t point = 0; point < grid.size(); ++point) {
    const auto verdict = static_cast<std::size_t>(table.verdict(point));
    ++all[verdict];
    const std::vector<double> values = values_at(grid, point);
    for (std::size_t k = 0; k < values.size(); ++k) ++by_value[{k, values[k]}][verdict];
  }
  EXPECT_EQ(reduced.counts(), all);
  for (std::size_t k = 0; k < grid.axes.size(); ++k) {
    for (std::size_t i = 0; i < grid.axes[k].values.size(); ++i) {
      EXPECT_EQ(reduced.counts_by_axis()[k][i], (by_value[{k, grid.axes[k].values[i]}]));
    }
  }
  for (const ReducedQuantity& kept : reduced.quantities()) {
    ReducedQuantity expected{.quantity = kept.quantity};
    for (std::size_t point = 0; point < grid.size(); ++point) {
      const bool is_at_rest = table.verdict(point) == Verdict::cannot_hunt ||
                              table.verdict(point) == Verdict::comes_to_rest;
      const double value = table[kept.quantity][point];
      if (std::isnan(value) || (is_at_rest && kept.quantity == Quantity::amplitude)) continue;
      ++expected.known;
      expected.sketch.add(value);
      const Extreme one{value, point};
      if (!expected.smallest || value < expected.smallest->value) expected.smallest = one;
      if (!expected.largest || value > expected.largest->value) expected.largest = one;
    }
    EXPECT_TRUE(kept == expected) << name_of(kept.quantity);
  }
}

TEST(PropertyReducedGrid, KeepsTheSameOfAnyPieces) {
  constexpr std::uint64_t seed = 1983;
  SCOPED_TRACE("seed " + std::to_string(seed));
  SeededDraws draws(seed);
  for (const std::vector<std::size_t>& counts :
       {std::vector<std::size_t>{40}, {7, 9}, {1, 12}, {12, 1}, {5, 4, 6}, {2, 1, 30}}) {
    const Grid grid = grid_of(counts);
    const Table table = random_table(grid, draws);
    ReducedGrid whole(grid, two_quantities, everything);
    whole.add(table);
    expect_kept(grid, table, whole);
    for (const std::size_t longest : {1U, 2U, 5U, 24U, 60U}) {
      EXPECT_EQ(reduced_in_pieces(grid, table, longest, 1000).packed(), whole.packed()) << longest;
      EXPECT_EQ(reduced_in_pieces(grid, table, longest, 2).packed(), whole.packed()) << longest;
    }
  }
}

TEST(PropertyReducedGrid, OfServosIsThatOfTheirTable) {
  const Grid grid = {
      .drive = drive_of({.friction_ratio = 0.1, .backlash = 0.3}),
      .axes = {spaced_axis("x", "servo.damping", 0.05, 0.65, 23, Spacing::linear),
               spaced_axis("y", "servo.inertia_ratio", 0.1, 10.0, 31, Spacing::logarithmic)}};
  const Table table = worked_out(grid);
  std::string packed;
  for (const std::size_t longest : {31U, 200U, 5000U}) {
    ReducedGrid reduced(grid, two_quantities, everything);
    evaluate_in_pieces(grid, two_quantities, 0, longest,
                       [&](const GridPiece& piece) { reduced.add(piece.table); });
    if (packed.empty()) {
      expect_kept(grid, table, reduced);
      packed = reduced.packed();
      EXPECT_GT(reduced.border().size(), 20U);
      EXPECT_LT(reduced.border().size(), grid.size() / 2);
    }
    EXPECT_EQ(reduced.packed(), packed);
  }
}

/// Words have no order: neighbors along them are none.
TEST(EdgeReducedGrid, AWordHasNoNeighbor) {
  Grid grid = grid_of({3});
  grid.drive = {};
  grid.axes = {{.path = "sensor.position", .values = {0.0, 1.0}}};
  Table table(2, {});
  table.column_of_verdicts()[0] = Verdict::hunts;
  table.column_of_verdicts()[1] = Verdict::comes_to_rest;
  ReducedGrid reduced(grid, {}, {.border = true});
  reduced.add(table);
  EXPECT_TRUE(reduced.border().empty());
}

TEST(EdgeReducedGrid, OtherTextsAreRefused) {
  const Grid grid = grid_of({7, 9});
  SeededDraws draws(7);
  ReducedGrid reduced(grid, two_quantities, everything);
  reduced.add(random_table(grid, draws));
  const std::string packed = reduced.packed();
  ReducedGrid again(grid, two_quantities, everything);
  EXPECT_TRUE(again.unpack(packed));
  EXPECT_FALSE(again.unpack(""));
  EXPECT_FALSE(again.unpack("2" + packed.substr(1)));
  EXPECT_FALSE(again.unpack(packed.substr(0, packed.size() / 2)));
  EXPECT_FALSE(again.unpack(packed + "0"));
  ReducedGrid other(grid_of({9, 9}), two_quantities, everything);
  EXPECT_FALSE(other.unpack(packed));
}

}  // namespace
}  // namespace gearlash::reduced_grid_test
