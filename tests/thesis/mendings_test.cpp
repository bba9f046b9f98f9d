// The program of 1960 with its properties put right: what each of them does.
#include "thesis/mendings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "thesis/chart_reading.hpp"
#include "thesis/settled_cycle.hpp"

namespace gearlash::thesis::mendings_test {
namespace {

TEST(Mendings, EachPropertyCarriesNumbersOfThePrintout) {
  ASSERT_EQ(mendings().front().mending, Mending{});
  EXPECT_EQ(numbers_reproduced(mendings().front().mending), 188);
  for (std::size_t i = 1; i < mendings().size(); ++i) {
    EXPECT_LT(numbers_reproduced(mendings()[i].mending), 188) << mendings()[i].name;
  }
}

/// With the load held still no longer and the contact found within the step, what is left of the
/// scheme is of higher order: the exact amplitude comes out.
TEST(OracleMendings, HeldLoadAndLateContactMakeLightlyDampedSizesTooLarge) {
  for (const double inertia_ratio : {0.25, 1.0, 4.0}) {
    const NormalizedServo servo{
        .damping = 0.1, .inertia_ratio = inertia_ratio, .friction_ratio = 0.2, .backlash = 0.3};
    const double as_it_was = amplitude_error(servo, {});
    const double with_either = std::min(amplitude_error(servo, {.shafts_together = true}),
                                        amplitude_error(servo, {.contact_interpolated = true}));
    const double mended =
        amplitude_error(servo, {.shafts_together = true, .contact_interpolated = true});
    EXPECT_GT(as_it_was, 0.02);
    EXPECT_LT(with_either, as_it_was);
    EXPECT_LT(std::abs(mended), 0.1 * as_it_was);
  }
}

TEST(OracleMendings, OldPositionAtContactMakesSmallSwingsTooSmall) {
  const NormalizedServo servo{
      .damping = 0.6, .inertia_ratio = 9.0, .friction_ratio = 1.0, .backlash = 0.3};
  EXPECT_LT(amplitude_error(servo, {}), -0.03);
  EXPECT_LT(std::abs(amplitude_error(servo, {.new_position_at_contact = true})), 0.006);
  EXPECT_LT(std::abs(amplitude_error(servo, {.fresh_first_stage = true})), 0.006);
}

TEST(EdgeSettledCycle, StepTooLongForTheServoIsTold) {
  // Runge and Kutta's fourth order is stable to a rate of 2.785 a step: c = 278.5.
  const auto run = [](double inertia_ratio) {
    return run_until_settled(program_parameters(
        {.damping = 0.6, .inertia_ratio = inertia_ratio, .friction_ratio = 0.2, .backlash = 0.3}));
  };
  EXPECT_TRUE(run(280.0).hunts);
  EXPECT_FALSE(run(280.0).diverged);
  EXPECT_TRUE(run(300.0).diverged);
  EXPECT_FALSE(run(300.0).settled);
}

TEST(OracleChartReading, ItsErrorIsTheProductOfItsCauses) {
  const NormalizedServo servo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.15, .backlash = 0.1};
  const auto error = reading_error(servo, read_chart(servo));
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR((1.0 + error->friction_ratio) * (1.0 + error->damping) *
                  (1.0 + error->inertia_ratio) * (1.0 + error->program),
              1.0 + error->whole, 1e-12);
  EXPECT_NEAR(error->program, 0.02, 0.01);
  // On a point of the grid nothing is interpolated.
  const NormalizedServo on_grid{
      .damping = 0.2, .inertia_ratio = 4.0, .friction_ratio = 0.1, .backlash = 0.3};
  const auto at_point = reading_error(on_grid, read_chart(on_grid));
  ASSERT_TRUE(at_point.has_value());
  EXPECT_NEAR(at_point->damping, 0.0, 1e-12);
  EXPECT_NEAR(at_point->inertia_ratio, 0.0, 1e-12);
  EXPECT_NEAR(at_point->friction_ratio, 0.0, 1e-12);
}

}  // namespace
}  // namespace gearlash::thesis::mendings_test
