// The ceiling of drives whose controller receives its error through a dead band or a compensation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/seeded_draws.hpp"
#include "gearlash/motion.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"

namespace gearlash::dead_band_ceiling_test {
namespace {

Drive servo() {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = 0.4,
                 .friction = {.viscous = 0.3, .coulomb = 0.03, .breakaway = 0.05}};
  drive.load = {.inertia = 0.6, .friction = {.viscous = 0.4, .coulomb = 0.01}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.5};
  return drive;
}

const CeilingTerm& term(const Ceiling& ceiling, const char* source) {
  return *std::find_if(ceiling.terms.begin(), ceiling.terms.end(),
                       [&](const CeilingTerm& one) { return one.source == source; });
}

/// A dead band of half a count's width is as bad as the counts.
TEST(OracleDeadBandCeiling, IsThatOfAnEncoder) {
  for (const bool is_sampled : {false, true}) {
    Drive drive = servo();
    if (is_sampled) drive.sampling = Sampling{.period = 1e-2};
    std::get<PID>(drive.controller.law).terms = PIDTerms::P;
    Drive counted = drive;
    counted.sensor.encoder.resolution = 0.02;
    const Ceiling of_counts = ceiling_of(reduce(counted));
    for (const DeadBand& band :
         {DeadBand{.width = 0.01},
          DeadBand{.width = 0.008, .hysteresis = 0.002, .form = DeadBandForm::whole}}) {
      drive.controller.dead_band = band;
      const Ceiling ceiling = ceiling_of(reduce(drive));
      ASSERT_TRUE(ceiling.load && of_counts.load);
      EXPECT_NEAR(term(ceiling, "dead band").size, 0.01, 1e-15);
      EXPECT_NEAR(term(ceiling, "dead band").load, term(of_counts, "encoder").load, 1e-12);
      EXPECT_NEAR(*ceiling.load, *of_counts.load, 1e-12);
    }
  }
}

TEST(DeadBandCeiling, ARelayHasNone) {
  Drive drive = servo();
  drive.controller.law = RelayController{.level = 1.0};
  drive.controller.dead_band.hysteresis = 0.01;
  const Ceiling ceiling = ceiling_of(reduce(drive));
  EXPECT_FALSE(ceiling.load);
  EXPECT_EQ(ceiling.reason, "a relay: the controller is not linear");
}

/// In the end no motion exceeds it.
TEST(PropertyDeadBandCeiling, IsAboveEveryMotion) {
  SeededDraws draws(20261124);
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    Drive drive = servo();
    drive.motor.inertia = draws.log_uniform(0.05, 1.0);
    drive.gearbox.backlash = draws.log_uniform(0.01, 0.3);
    drive.sensor.position = draws.happens(0.5) ? SensorPlace::load : SensorPlace::motor;
    if (draws.happens(0.5)) drive.sampling = Sampling{.period = draws.log_uniform(0.01, 0.2)};
    const double width = draws.log_uniform(0.01, 0.3);
    if (draws.happens(0.3)) {
      drive.controller.compensation = {.backlash = drive.gearbox.backlash,
                                       .input = CompensationInput::error,
                                       .take_up_angle = width};
    } else {
      drive.controller.dead_band = {.width = width};
      if (draws.happens(0.5)) {
        drive.controller.dead_band.form = DeadBandForm::whole;
        drive.controller.dead_band.hysteresis = 0.3 * width;
      }
    }
    const Ceiling ceiling = ceiling_of(reduce(drive));
    if (!ceiling.load) continue;
    ++compared;
    const Motion motion =
        simulate(drive, {.until = 200.0, .start = Start{.load_position = 3.0 * *ceiling.load}});
    for (double time = 150.0; time <= 200.0; time += 0.05) {
      ASSERT_LE(std::abs(motion.at(time).shafts.load_position), *ceiling.load * 1.000001) << i;
      ASSERT_LE(std::abs(motion.at(time).shafts.motor_position), *ceiling.motor * 1.000001) << i;
    }
  }
  EXPECT_GT(compared, 30);
}

}  // namespace
}  // namespace gearlash::dead_band_ceiling_test
