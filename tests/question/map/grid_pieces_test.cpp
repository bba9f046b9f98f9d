// A grid in pieces is the grid at once, and its work ends when it should.
#include "question/map/grid_pieces.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/same_bits.hpp"
#include "base/stopping.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::grid_pieces_test {
namespace {

Grid grid_of_servos() {
  return {.drive = drive_of({.friction_ratio = 0.1, .backlash = 0.3}),
          .axes = {spaced_axis("x", "servo.damping", 0.05, 0.65, 23, Spacing::linear),
                   spaced_axis("y", "servo.inertia_ratio", 0.1, 10.0, 31, Spacing::logarithmic)}};
}

/// Few, since each is a search for cycles of its own.
Grid grid_of_bouncing_servos() {
  return {.drive = drive_of({.friction_ratio = 0.1, .backlash = 0.3, .restitution = 0.1}),
          .axes = {spaced_axis("x", "servo.damping", 0.3, 0.65, 2, Spacing::linear),
                   spaced_axis("y", "servo.inertia_ratio", 1.0, 3.0, 5, Spacing::logarithmic)}};
}

class GridInPieces : public testing::TestWithParam<std::size_t> {};

TEST_P(GridInPieces, IsTheGridAtOnce) {
  for (const Grid& grid : {grid_of_servos(), grid_of_bouncing_servos()}) {
    Table whole = table_of(grid.size());
    const RowCount at_once = work_out(grid, 0, whole);
    std::size_t next = 0;
    const RowCount count =
        evaluate_in_pieces(grid, solved_quantities, 0, GetParam(), [&](const GridPiece& piece) {
          ASSERT_EQ(piece.first, next);
          ASSERT_LE(piece.table.rows(), GetParam());
          for (std::size_t row = 0; row < piece.table.rows(); ++row) {
            ASSERT_TRUE(same_bits(piece.table, whole, row, next + row)) << next + row;
          }
          next += piece.table.rows();
        });
    EXPECT_EQ(next, grid.size());
    EXPECT_FALSE(count.stopped);
    EXPECT_EQ(count.solved.side_by_side, at_once.solved.side_by_side);
    EXPECT_EQ(count.solved.one_by_one, at_once.solved.one_by_one);
  }
}

INSTANTIATE_TEST_SUITE_P(Lengths, GridInPieces, testing::Values(1, 30, 31, 32, 100, 713, 5000));

TEST(EdgeGridInPieces, GoesOnFromWhereAPieceEnded) {
  const Grid grid = grid_of_servos();
  std::size_t first = 5 * 31;
  evaluate_in_pieces(grid, solved_quantities, first, 62, [&](const GridPiece& piece) {
    EXPECT_EQ(piece.first, first);
    first += piece.table.rows();
  });
  EXPECT_EQ(first, grid.size());
  const RowCount nothing = evaluate_in_pieces(grid, solved_quantities, grid.size(), 62,
                                              [](const GridPiece&) { FAIL(); });
  EXPECT_FALSE(nothing.stopped);
}

TEST(EdgeGridInPieces, StopsWhenAsked) {
  const Grid grid = grid_of_servos();
  for (const std::size_t most : {0U, 1U, 200U, 500U}) {
    std::size_t taken = 0;
    auto progress =
        test::Stopping::at(static_cast<double>(most) / static_cast<double>(grid.size()));
    const RowCount count = evaluate_in_pieces(
        grid, solved_quantities, 0, 31,
        [&](const GridPiece& piece) { taken += piece.table.rows(); }, progress);
    EXPECT_TRUE(count.stopped) << most;
    EXPECT_EQ(count.solved.side_by_side + count.solved.one_by_one, taken);
    EXPECT_LE(taken, most + 31);  // a piece may be done as it is heard of
  }
}

TEST(EdgeGridInPieces, WhatItsTakerThrowsIsThrownOn) {
  std::size_t pieces = 0;
  EXPECT_THROW(evaluate_in_pieces(grid_of_servos(), solved_quantities, 0, 31,
                                  [&](const GridPiece&) {
                                    if (++pieces == 3) throw std::runtime_error("disk full");
                                  }),
               std::runtime_error);
  EXPECT_EQ(pieces, 3U);
}

}  // namespace
}  // namespace gearlash::grid_pieces_test
