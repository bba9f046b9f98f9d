// The words of InvalidInput are bounded, its faults are not.
#include "gearlash/fault.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace gearlash::fault_test {
namespace {

TEST(InvalidInput, SaysAHundredAndCountsTheOthers) {
  for (const std::size_t count : {1U, 100U, 101U, 115'000U}) {
    const InvalidInput fault(std::vector<Fault>(count, {"a.b", "x", "must be a number", ""}));
    const std::string text = fault.what();
    EXPECT_EQ(fault.faults().size(), count);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
              static_cast<long>(std::min<std::size_t>(count - 1, 100)));
    const std::string last = text.substr(text.rfind('\n') + 1);
    EXPECT_EQ(last, count > 100 ? "and " + std::to_string(count - 100) + " more"
                                : "a.b = x: must be a number");
  }
}

}  // namespace
}  // namespace gearlash::fault_test
