// Tables that other programs open as they are.
#include "output/csv_table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace gearlash::csv_table_test {
namespace {

class CsvTables : public testing::Test {
 protected:
  CsvTable table(const std::vector<std::string>& columns) {
    return CsvTable([this](std::string_view text) { written += text; }, columns);
  }
  std::string written;
};

TEST_F(CsvTables, BeginWithTheirColumns) {
  table({"time_s", "load_position_rad", "mode"}).row(0.5, -2e-300, "apart");
  EXPECT_EQ(written, "time_s,load_position_rad,mode\n0.5,-2e-300,apart\n");
}

TEST_F(CsvTables, HaveUnitsInTheNamesOfColumns) {
  EXPECT_EQ(column_in("rad/s", "motor_speed"), "motor_speed_rad_per_s");
  EXPECT_EQ(column_in("N m/(rad s)", "integral"), "integral_N_m_per_rad_s");
  EXPECT_EQ(column_in("1", "damping"), "damping");
}

TEST_F(CsvTables, HaveNumbersThatReadBack) {
  const double value = 0.1 + 0.2;
  table({"a"}).row(value);
  EXPECT_EQ(std::stod(written.substr(2)), value);
}

TEST_F(CsvTables, LeaveEmptyWhatIsNotKnown) {
  const double infinite = std::numeric_limits<double>::infinity();
  table({"a", "b", "c", "d", "e"})
      .row(std::numeric_limits<double>::quiet_NaN(), std::optional<double>{},
           std::optional<double>(2.0), infinite, std::size_t{7});
  EXPECT_EQ(written, "a,b,c,d,e\n,,2,inf,7\n");
}

TEST_F(CsvTables, QuoteTextThatWouldEndACell) {
  table({"a", "b", "c"}).row("one, two", "a \"gap\"", " blank");
  EXPECT_EQ(written, "a,b,c\n\"one, two\",\"a \"\"gap\"\"\",\" blank\"\n");
}

TEST_F(CsvTables, HaveRowsOfOneLength) {
  CsvTable two = table({"a", "b"});
  EXPECT_THROW(two.row(1.0), std::logic_error);
}

}  // namespace
}  // namespace gearlash::csv_table_test
