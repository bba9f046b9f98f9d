// A table in large pages is the same table.
#include "gearlash/io/large_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gearlash {
namespace {

TEST(LargeTable, IsATableInWhichNothingIsKnown) {
  for (const std::size_t rows : {0U, 1U, 1'000U, 700'001U}) {
    CycleTable table = large_cycle_table(rows);
    ASSERT_EQ(table.verdict, CycleTable(rows).verdict);
    for (const CycleQuantity quantity : all_quantities) {
      ASSERT_EQ(table[quantity].size(), rows);
      ASSERT_TRUE(std::all_of(table[quantity].begin(), table[quantity].end(),
                              [](double value) { return std::isnan(value); }));
    }
    ASSERT_EQ(table.columns().size.size(), rows);
  }
}

}  // namespace
}  // namespace gearlash
