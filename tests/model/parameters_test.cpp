// The registry of parameters: every entry names one place of a drive, and get() and set() agree.
#include "model/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "gearlash/parameter.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::parameters_test {
namespace {

Drive joint() {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = 2e-4,
                 .friction = {.viscous = 1e-4, .coulomb = 3e-3},
                 .limit = 0.2};
  drive.gearbox = {.ratio = 50.0, .backlash = 0.0035};
  drive.load = {.inertia = 0.02, .friction = {.viscous = 0.01}};
  drive.controller.law = PID{.terms = PIDTerms::PID,
                             .proportional = 0.5,
                             .integral = 1.0,
                             .derivative = 0.02,
                             .filter = 5e-3};
  return drive;
}

/// All kinds of drives between them have every parameter.
std::vector<Drive> drives_of_all_kinds() {
  std::vector<Drive> drives = {normal_form(0.2, 1.0, 0.2), joint()};
  for (const MotorKind& kind : {MotorKind(ArmatureControl{0.1, 0.1, 1.0}),
                                MotorKind(FieldControl{0.1, 1.0}), MotorKind(TwoPhase{0.1, 0.1})}) {
    drives.push_back(joint());
    drives.back().motor.kind = kind;
  }
  const Parameter& kind = *find_parameter("controller.kind");
  for (std::size_t choice = 0; choice < kind.choices.size(); ++choice) {
    drives.push_back(joint());
    std::get<Choice>(kind.slot(drives.back())).choose(drives.back(), choice);
  }
  drives.push_back(joint());
  drives.back().motor = {.kind = ArmatureControl{0.1, 0.1, 1.0}, .no_load_current = 0.1};
  drives.push_back(joint());
  drives.back().motor = {.kind = TorqueControl{0.03}, .current_limit = 6.0};
  drives.push_back(joint());
  drives.back().motor.friction.breakaway = drives.back().load.friction.breakaway = 4e-3;
  drives.back().controller.dead_band = {.width = 0.1, .form = DeadBandForm::whole};
  for (const CompensationInput input : {CompensationInput::reference, CompensationInput::error}) {
    drives.push_back(joint());
    drives.back().controller.compensation = {
        .friction = 0.1, .backlash = 0.003, .input = input, .take_up_angle = 0.001};
  }
  drives.push_back(joint());
  drives.back().contact = CompliantContact{500.0, 1.0};
  for (const Signal& signal :
       {Signal(1.0), Signal(StepSignal{}), Signal(RampSignal{}), Signal(SineSignal{}),
        Signal(TrapezoidSignal{}), Signal(TableSignal{})}) {
    drives.push_back(joint());
    drives.back().sampling = Sampling{.period = 1e-3};
    drives.back().reference = signal;
    drives.back().load_torque = signal;
  }
  return drives;
}

TEST(Parameters, EachIsInSomeDriveAndHasASentence) {
  const std::vector<Drive> drives = drives_of_all_kinds();
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const bool is_somewhere = std::any_of(
        drives.begin(), drives.end(), [&](const Drive& drive) { return exists(parameter, drive); });
    EXPECT_TRUE(is_somewhere) << parameter.path;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.path;
    EXPECT_NE(parameter.section(), parameter.path) << parameter.path;
  }
}

TEST(Parameters, NoDriveHasTwoOfOneName) {
  for (const Drive& drive : drives_of_all_kinds()) {
    std::set<std::string_view> paths;
    for (const Parameter& parameter : all_parameters_of_drives()) {
      if (exists(parameter, drive)) {
        EXPECT_TRUE(paths.insert(parameter.path).second) << parameter.path;
      }
    }
  }
}

TEST(Parameters, ANumberThatIsSetIsTheOneThatIsRead) {
  for (const Drive& original : drives_of_all_kinds()) {
    for (const ParameterInfo& info : parameters_of(original)) {
      if (info.kind != ParameterKind::number) continue;
      Drive drive = original;
      set(drive, info.path, 0.125);
      EXPECT_EQ(get(drive, info.path), 0.125) << info.path;
      EXPECT_FALSE(drive == original && info.path != "sensor.resolution") << info.path;
    }
  }
}

TEST(Parameters, EveryOtherChoiceMakesAnotherDrive) {
  for (const Drive& original : drives_of_all_kinds()) {
    for (const Parameter& parameter : all_parameters_of_drives()) {
      Drive drive = original;
      const Slot slot = parameter.slot(drive);
      const auto* choice = std::get_if<Choice>(&slot);
      if (choice == nullptr) continue;
      for (std::size_t word = 0; word < parameter.choices.size(); ++word) {
        choice->choose(drive, word);
        EXPECT_EQ(choice->chosen(drive), word) << parameter.path;
        drive = original;
      }
    }
  }
}

TEST(Parameters, AliasesAndInverseFormsAreTheSameNumber) {
  Drive drive = joint();
  set(drive, "controller.kp", 0.75);
  EXPECT_EQ(get(drive, "controller.proportional"), 0.75);
  EXPECT_EQ(get(drive, "loop.error_gain"), 0.75);
  set(drive, "sampling.frequency", 2.0 * std::numbers::pi * 1000.0);  // 1 kHz
  EXPECT_DOUBLE_EQ(get(drive, "sampling.period"), 1e-3);
  drive.controller.law = CascadeController{};
  set(drive, "sampling.position_frequency", 2.0 * std::numbers::pi * 250.0);
  EXPECT_DOUBLE_EQ(get(drive, "sampling.position_period"), 4e-3);
  drive.motor.kind = ArmatureControl{};
  set(drive, "motor.speed_constant", 20.0);
  EXPECT_DOUBLE_EQ(get(drive, "motor.back_emf_constant"), 0.05);
}

TEST(Parameters, ElementsOfMatricesHaveIndices) {
  Drive drive = joint();
  drive.controller.law =
      StateSpaceController{1.0, {{0.0, 1.0}, {2.0, 3.0}}, {{1.0}, {0.0}}, {1, 0}, {0.5}};
  EXPECT_EQ(get(drive, "controller.A[1][0]"), 2.0);
  set(drive, "controller.A[1][0]", -4.0);
  EXPECT_EQ(std::get<StateSpaceController>(drive.controller.law).A[1][0], -4.0);
  EXPECT_THROW(set(drive, "controller.A[2][0]", 1.0), InvalidInput);
  EXPECT_THROW(set(drive, "controller.A[1]", 1.0), InvalidInput);
  EXPECT_THROW(set(drive, "controller.A[1", 1.0), InvalidInput);
  EXPECT_THROW(static_cast<void>(get(drive, "controller.A[x][0]")), InvalidInput);
}

TEST(Parameters, WhatADriveDoesNotHaveIsRefused) {
  Drive drive = joint();
  for (const char* path : {"motor.resistance", "servo.damping", "motor", "", "motor.colour"}) {
    EXPECT_THROW(set(drive, path, 1.0), InvalidInput) << path;
    EXPECT_THROW(static_cast<void>(get(drive, path)), InvalidInput) << path;
  }
  EXPECT_THROW(set(drive, "motor.kind", 1.0), InvalidInput);
}

TEST(Parameters, BreakawayIsCoulombFrictionWhereItIsNotGiven) {
  Drive drive = joint();
  EXPECT_EQ(get(drive, "motor.breakaway"), 3e-3);
  set(drive, "motor.breakaway", 5e-3);
  EXPECT_EQ(get(drive, "motor.breakaway"), 5e-3);
}

TEST(Parameters, DryFrictionAndNoLoadCurrentExcludeEachOther) {
  Drive drive = joint();
  drive.motor = {.kind = ArmatureControl{0.1, 0.1, 1.0}, .inertia = 2e-4};
  set(drive, "motor.no_load_current", 0.2);
  EXPECT_DOUBLE_EQ(coulomb_torque(drive.motor), 0.02);
  EXPECT_THROW(set(drive, "motor.coulomb", 0.01), InvalidInput);
  drive.motor.friction.coulomb = 0.01;
  ASSERT_EQ(faults(drive).size(), 1U);
  EXPECT_EQ(faults(drive)[0].path, "motor.coulomb");
  drive.motor.no_load_current.reset();
  EXPECT_DOUBLE_EQ(coulomb_torque(drive.motor), 0.01);
  EXPECT_THROW(set(drive, "motor.no_load_current", 0.2), InvalidInput);
}

TEST(FaultsOfDrives, ASoundDriveHasNone) { EXPECT_TRUE(faults(joint()).empty()); }

TEST(ReducedDrives, NumbersAreReferredToTheLoadByTheGearRatio) {
  const drive::ReducedDrive reduced = reduce(joint());
  EXPECT_DOUBLE_EQ(reduced.motor.inertia, 2e-4 * 2500.0);
  EXPECT_DOUBLE_EQ(reduced.motor.friction.coulomb, 3e-3 * 50.0);
  EXPECT_DOUBLE_EQ(reduced.torque_limit, 0.2 * 50.0);
  Drive at_motor = joint();
  at_motor.controller.shaft = GainShaft::motor;
  const drive::ReducedDrive per_motor = reduce(at_motor);
  EXPECT_DOUBLE_EQ(reduced.controller.direct[0], 225.0);  // proportional + derivative/filter
  EXPECT_DOUBLE_EQ(per_motor.controller.direct[0], 11250.0);
}

/// Thresholds and additions are those of the gains' shaft, a backlash that of the load's.
TEST(ReducedDrives, DeadBandsAndCompensationsAreReferredToTheLoad) {
  Drive drive = joint();
  drive.motor.friction.breakaway = 5e-3;
  drive.motor.friction.stribeck_speed = 10.0;
  drive.controller.dead_band = {.width = 0.1, .hysteresis = 0.02, .form = DeadBandForm::whole};
  drive.controller.compensation = {
      .friction = 4e-3, .friction_speed = 5.0, .backlash = 0.003, .take_up_time = 0.1};
  drive.sampling = Sampling{.period = 1e-3};
  EXPECT_TRUE(faults(drive).empty());
  EXPECT_DOUBLE_EQ(reduce(drive).motor.friction.stribeck_speed, 0.2);
  EXPECT_TRUE(reduce(drive).feedforward.is_absent());  // while the reference stands
  drive.reference = TrapezoidSignal{.to = 1.0, .speed = 1.0, .acceleration = 1.0};
  EXPECT_TRUE(reduce_settled(drive).feedforward.is_absent());
  for (const auto& [shaft, torque, angle] :
       {std::tuple{GainShaft::load, 1.0, 1.0}, std::tuple{GainShaft::mixed, 50.0, 1.0},
        std::tuple{GainShaft::motor, 50.0, 0.02}}) {
    drive.controller.shaft = shaft;
    const drive::ReducedDrive reduced = reduce(drive);
    EXPECT_DOUBLE_EQ(reduced.error_shape.begins, 0.12 * angle);
    EXPECT_DOUBLE_EQ(reduced.error_shape.ends, 0.08 * angle);
    EXPECT_TRUE(reduced.error_shape.jumps);
    EXPECT_DOUBLE_EQ(reduced.feedforward.torque, 4e-3 * torque);
    EXPECT_DOUBLE_EQ(reduced.feedforward.speed, 5.0 * angle);
    EXPECT_EQ(reduced.feedforward.half_gap, 0.0015);
    Drive of_relay = drive;
    of_relay.controller.law = RelayController{.level = 0.3};
    EXPECT_DOUBLE_EQ(reduce(of_relay).controller.direct[0], 0.3 * torque);
  }
}

TEST(ReducedDrives, TheLargestCurrentIsATorqueAtTheLoad) {
  Drive drive = joint();
  drive.motor.kind = ArmatureControl{0.03, 0.03, 0.3, 8e-5};
  drive.motor.limit = 24.0;
  set(drive, "motor.current_limit", 6.0);
  const drive::ReducedDrive reduced = reduce(drive);
  EXPECT_DOUBLE_EQ(reduced.winding.torque_limit, 0.03 * 6.0 * 50.0);
  EXPECT_DOUBLE_EQ(reduced.torque_limit, 24.0 * 0.1 * 50.0);
  EXPECT_TRUE(faults(drive).empty());
  EXPECT_FALSE(proportional_servo(drive));
}

TEST(ReducedDrives, RulesOfDeadBandsAndRelaysAreNamed) {
  const auto fault_of = [](const auto& change) {
    Drive drive = joint();
    change(drive);
    const std::vector<Fault> found = faults(drive);
    return found.empty() ? std::string() : found.front().path;
  };
  EXPECT_EQ(fault_of([](Drive& d) { d.controller.law = RelayController{.level = 1.0}; }),
            "controller.hysteresis");
  EXPECT_EQ(fault_of([](Drive& d) { d.controller.law = RelayController{}; }), "controller.level");
  EXPECT_EQ(fault_of([](Drive& d) {
              d.controller.dead_band = {.width = 0.1, .form = DeadBandForm::whole};
            }),
            "controller.hysteresis");
  EXPECT_EQ(fault_of([](Drive& d) {
              d.controller.dead_band = {
                  .width = 0.1, .hysteresis = 0.2, .form = DeadBandForm::whole};
            }),
            "controller.hysteresis");
  EXPECT_EQ(fault_of([](Drive& d) {
              d.controller.dead_band.width = 0.1;
              d.controller.compensation = {
                  .backlash = 0.1, .input = CompensationInput::error, .take_up_angle = 0.1};
            }),
            "controller.backlash_compensation");
  EXPECT_EQ(fault_of([](Drive& d) {
              d.controller.dead_band.width = 0.1;
              d.controller.law =
                  StateSpaceController{1.0, {{-1.0}}, {{2.0, -1.0, 0.0}}, {1.0}, {1.0, -1.0, 0.0}};
            }),
            "controller.dead_band");
}

TEST(ReducedDrives, TheClosedFormIsFoundByPhysics) {
  Drive drive = joint();
  drive.motor.friction.coulomb = 0.0;
  drive.motor.limit.reset();
  EXPECT_FALSE(proportional_servo(drive));
  // An integrator without gain, and no derivative: proportional control.
  drive.controller.law = PID{.terms = PIDTerms::PI, .proportional = 0.5};
  const auto closed = proportional_servo(drive);
  ASSERT_TRUE(closed);
  drive.controller.law = PID{.proportional = 0.5};
  EXPECT_EQ(closed->servo, proportional_servo(drive)->servo);
  EXPECT_TRUE(proportional_servo(normal_form(0.2, 1.0, 0.2))->is_as_given);
}

}  // namespace
}  // namespace gearlash::parameters_test
