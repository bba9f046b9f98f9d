// The error in the end, what it is due to, and the step and band that a drive is asked for.
#include "question/causes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/lists.hpp"
#include "gearlash/analyse.hpp"
#include "model/reduced_drive.hpp"
#include "question/step_response.hpp"

namespace gearlash::causes_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// 1 kg m² on both sides together, PD control of the motor's position, and dry friction.
Drive resting() {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 0.4, .friction = {.viscous = 0.1}};
  drive.motor.friction.coulomb = 0.2;
  drive.load = {.inertia = 0.6, .friction = {.viscous = 0.1}};
  drive.load.friction.coulomb = 0.1;
  drive.gearbox.backlash = 0.02;
  drive.sensor.position = SensorPlace::motor;
  drive.controller.law =
      PID{.terms = PIDTerms::PD, .proportional = 100.0, .derivative = 12.0, .filter = 1e-3};
  return drive;
}

const Without* found(const Answer& answer, Cause cause) {
  return first_of(answer.without, [&](const Without& one) { return one.cause == cause; });
}

// ---- step and band ------------------------------------------------------------------------------

TEST(AskedStep, IsOneDegreeOrOneRadianOfANormalForm) {
  EXPECT_DOUBLE_EQ(drive::step_of(resting()), degree);
  EXPECT_EQ(drive::step_of(normal_form(0.2, 1.0, 0.3, 0.1)), 1.0);
  Drive drive = resting();
  drive.specification.step = -0.3;
  EXPECT_EQ(drive::step_of(drive), -0.3);
}

TEST(AskedBand, IsGivenOrTheSpecificationOrACountOrAShareOfTheStep) {
  Drive drive = resting();
  const auto band = [&] { return drive::band_of(drive, reduce(drive)); };
  EXPECT_DOUBLE_EQ(band(), 0.01 * degree);
  drive.gearbox.backlash = 0.5;
  EXPECT_DOUBLE_EQ(band(), 0.01 * degree);  // whatever the gap
  drive.gearbox.ratio = 10.0;
  drive.sensor.encoder.counts_per_turn = 1000.0;  // of the motor
  EXPECT_DOUBLE_EQ(band(), 2.0 * std::numbers::pi / 1000.0 / 10.0);
  drive.specification.error = 0.004;
  EXPECT_EQ(band(), 0.004);
  drive.specification.band = 0.001;
  EXPECT_EQ(band(), 0.001);
}

// ---- causes -------------------------------------------------------------------------------------

TEST(Causes, AreThoseThatADriveHas) {
  Drive drive = resting();
  EXPECT_TRUE(without(drive, Cause::gap));
  EXPECT_EQ(without(drive, Cause::dry_friction)->load.friction.coulomb, 0.0);
  for (const Cause cause :
       {Cause::integral_action, Cause::delay, Cause::encoder, Cause::load_torque}) {
    EXPECT_FALSE(without(drive, cause)) << name_of(cause);
  }
  drive.controller.law =
      PID{.terms = PIDTerms::PI, .proportional = 100.0, .integral = 3.0, .tracking_time = 0.1};
  drive.sampling = Sampling{.period = 1e-3, .delay = 5e-4};
  drive.load.gravity = 1.0;
  EXPECT_EQ(std::get<PID>(without(drive, Cause::integral_action)->controller.law),
            (PID{.terms = PIDTerms::P, .proportional = 100.0}));
  EXPECT_FALSE(without(drive, Cause::delay)->sampling);
  EXPECT_EQ(without(drive, Cause::load_torque)->load.gravity, 0.0);
  drive.sensor.encoder.counts_per_turn = 1e4;  // read by a computer alone
  EXPECT_EQ(without(drive, Cause::delay)->sampling, (Sampling{.period = 1e-3, .delay = 0.0}));
  EXPECT_FALSE(without(drive, Cause::encoder)->sensor.encoder.counts_per_turn);
}

/// Half the gap, and dry friction over the gain.
TEST(Causes, ShareTheErrorAtRest) {
  const Drive drive = resting();
  const Answer answer = analyse(drive, {.causes = true});
  ASSERT_FALSE(hunts(answer.verdict));
  const double friction = (0.2 + 0.1) / 100.0;
  EXPECT_NEAR(answer.value(Quantity::error).value(), 0.01 + friction, 1e-9);
  EXPECT_EQ(answer.value(Quantity::error), answer.value(Quantity::error_if_disturbed));
  ASSERT_NE(found(answer, Cause::gap), nullptr);
  EXPECT_NEAR(found(answer, Cause::gap)->error.value(), 1e-3 * 0.01 + friction, 1e-9);
  ASSERT_NE(found(answer, Cause::dry_friction), nullptr);
  EXPECT_NEAR(found(answer, Cause::dry_friction)->error.value(), 0.01, 1e-3 * 0.01);
}

/// Its amplitude is proportional to the gap, so that it hunts with any; without the gap it does
/// not.
TEST(Causes, OfTheServoOf1960IsItsGap) {
  const Answer answer = analyse(normal_form(0.19, 2.0, 0.1, 0.3), {.causes = true});
  ASSERT_EQ(answer.without.size(), 1U);
  EXPECT_EQ(answer.without[0].cause, Cause::gap);
  EXPECT_EQ(answer.without[0].verdict, Verdict::comes_to_rest);
  EXPECT_NEAR(answer.value(Quantity::error).value(), 0.241611108, 1e-9);
}

// ---- the specification --------------------------------------------------------------------------

TEST(SpecificationAnswer, IsMetNotMetOrNotKnown) {
  Drive drive = resting();
  EXPECT_FALSE(analyse(drive).specification);
  drive.specification.error = 0.0131;
  EXPECT_EQ(analyse(drive).specification->small, Fulfilment::met);
  drive.specification.error = 0.0129;
  const SpecificationAnswer missed = analyse(drive, {.causes = true}).specification.value();
  EXPECT_EQ(missed.small, Fulfilment::not_met);
  EXPECT_NEAR(missed.excess.value(), 0.013 - 0.0129, 1e-8);
  EXPECT_EQ(missed.cause, Cause::gap);
  Answer open;
  open.search = SearchRecord{.starts = {{.load_position = 0.1, .end = "undecided"}}};
  EXPECT_EQ(judged_specification(drive, open)->small, Fulfilment::not_known);
  open.search->starts[0].end = "diverges";
  EXPECT_EQ(judged_specification(drive, open)->small, Fulfilment::not_met);
}

/// Of a sine that the loop follows with its faces together, but for the gap of 1e-9 rad.
TEST(EndError, OfAMovingReferenceIsItsLag) {
  Drive drive = resting();
  drive.motor.friction.coulomb = drive.load.friction.coulomb = 0.0;
  drive.gearbox.backlash = 1e-9;
  drive.reference = SineSignal{.amplitude = 0.3, .frequency = 2.0};
  const Answer answer = analyse(drive, {.loop = true, .borders = false});
  ASSERT_EQ(answer.verdict, Verdict::forced);
  ASSERT_TRUE(answer.loop && answer.loop->lag);
  EXPECT_NEAR(answer.value(Quantity::error).value(), *answer.loop->lag, 1e-6 * 0.3);
}

}  // namespace
}  // namespace gearlash::causes_test
