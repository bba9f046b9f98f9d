// The modes of a drive: numbered without a list, made when they are first entered.
#include <gtest/gtest.h>

#include <set>

#include "controllers.hpp"
#include "general/assemble/drive_system.hpp"
#include "general/assemble/moving_frame.hpp"

namespace gearlash::drive::drive_modes_test {
namespace {

constexpr ShaftFriction dry{.viscous = 0.1, .coulomb = 0.5, .breakaway = 1.0};

/// Dry friction on both shafts and a torque limit.
ReducedDrive full_drive(const Contact& contact) {
  ReducedDrive drive;
  drive.motor = {1.0, dry};
  drive.load = {2.0, dry};
  drive.backlash = 0.01;
  drive.contact = contact;
  drive.torque_limit = 10.0;
  drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                 .proportional = 40.0,
                                 .integral = 20.0,
                                 .derivative = 13.0,
                                 .tracking_time = 0.5});
  return drive;
}

const CompliantContact damped{.stiffness = 1e3, .damping = 5.0, .law = ContactDamping::limited};

/// The same system with its modes as a list.
hybrid::HybridSystem listed(const hybrid::HybridSystem& system) {
  hybrid::HybridSystem list{.state_names = system.state_names, .clocks = system.clocks};
  for (std::size_t i = 0; i < system.mode_count(); ++i) list.modes.push_back(system.mode(i));
  return list;
}

TEST(DriveModes, AreNumberedWithoutGaps) {
  for (const Contact& contact : {Contact(RigidContact{}), Contact(damped)}) {
    const DriveModes modes(full_drive(contact));
    EXPECT_EQ(modes.count(), std::holds_alternative<RigidContact>(contact) ? 45U : 189U);
    std::set<std::string> names;
    for (std::size_t i = 0; i < modes.count(); ++i) {
      EXPECT_EQ(modes.index_of(modes.mode(i)), i);
      names.insert(text_of(modes.mode(i)));
    }
    EXPECT_EQ(names.size(), modes.count());
  }
}

/// With every automaton at once: 7 · 25 or 25 + 2 · 9 states of contact and frictions, and three of
/// each of six others.
TEST(DriveModes, OfEveryAutomatonAreNumberedAndSound) {
  for (const Contact& contact : {Contact(RigidContact{.restitution = 0.5}), Contact(damped)}) {
    ReducedDrive drive = full_drive(contact);
    drive.motor.friction.stribeck_speed = drive.load.friction.stribeck_speed = 0.3;
    drive.winding = {.time_constant = 1e-3, .back_emf = 0.1, .torque_limit = 7.0};
    drive.error_shape = {.begins = 0.2, .ends = 0.1, .inner_gain = 0.0, .jumps = true};
    drive.feedforward = {.torque = 0.1, .half_gap = 0.005, .take_up_time = 0.1};
    drive.reference = Sine{.amplitude = 1.0, .frequency = 2.0};
    drive.sampling = Sampling{.period = 1e-3, .delay = 2.5e-3};
    const DriveSystem built = drive_system(drive);
    const bool is_rigid = std::holds_alternative<RigidContact>(contact);
    ASSERT_EQ(built.modes.count(), (is_rigid ? 25U + 2U * 9U : 7U * 25U) * 729U);
    for (std::size_t i = 0; i < built.modes.count(); ++i) {
      ASSERT_EQ(built.modes.index_of(built.modes.mode(i)), i);
    }
    for (std::size_t i = 0; i < built.modes.count(); i += 97) {
      ASSERT_TRUE(hybrid::faults_of_mode(built.system, i).empty()) << text_of(built.modes.mode(i));
    }
  }
  const DriveModes few(full_drive(damped));
  DriveMode foreign = few.mode(0);
  foreign.error = Branch::forward;
  EXPECT_FALSE(few.has(foreign));
}

TEST(DriveModes, RigidFacesTogetherHaveNoShaftsThatMoveApart) {
  const DriveModes modes(full_drive(RigidContact{}));
  EXPECT_TRUE(modes.has({ContactState::forward, FrictionState::sticking, FrictionState::sticking}));
  EXPECT_FALSE(modes.has({ContactState::forward, FrictionState::forward, FrictionState::sticking}));
  EXPECT_TRUE(modes.has({ContactState::apart, FrictionState::forward, FrictionState::sticking}));
  EXPECT_FALSE(
      modes.has({ContactState::forward_limited, FrictionState::sticking, FrictionState::sticking}));
}

TEST(DriveModes, AreMadeWhenTheyAreFirstEntered) {
  const ReducedDrive drive = full_drive(damped);
  const DriveSystem built = drive_system(drive);
  EXPECT_EQ(built.system.mode_count(), 189U);
  EXPECT_EQ(built.system.source.made(), 0U);
  const auto motion =
      simulate(built.system, drive_start(drive, built, {.motor_position = 0.2}), {.until = 5.0});
  std::set<std::size_t> entered = {motion.at(0.0).mode};
  for (const hybrid::Event& event : motion.events()) {
    entered.insert(event.mode);
    entered.insert(event.mode_after);
  }
  EXPECT_EQ(built.system.source.made(), entered.size());
  EXPECT_LT(entered.size(), 40U);
}

TEST(DriveModes, HaveNoFaults) {
  for (const Contact& contact : {Contact(RigidContact{.restitution = 0.5}), Contact(damped)}) {
    for (const bool is_sampled : {false, true}) {
      ReducedDrive drive = full_drive(contact);
      if (is_sampled) drive.sampling = Sampling{.period = 1e-3, .delay = 5e-4};
      EXPECT_TRUE(hybrid::faults(listed(drive_system(drive).system)).empty());
    }
  }
}

/// Drives with signals and controllers of every kind that may follow themselves alone.
std::vector<ReducedDrive> signalled_drives() {
  std::vector<ReducedDrive> drives;
  for (const Signal& reference :
       {Signal(0.0), Signal(Ramp{.rate = 1.0}), Signal(Sine{.amplitude = 1.0, .frequency = 2.0})}) {
    ReducedDrive drive = full_drive(RigidContact{});
    drive.reference = reference;
    drive.load_torque = Sine{.mean = 0.1, .amplitude = 0.2, .frequency = 3.0};
    drives.push_back(drive);
    drive.contact = damped;
    drives.push_back(drive);
    // A filter of the reference before a proportional loop; the second state watches the load.
    drive.controller = LinearController{.state_matrix = {{-5.0, 0.0}, {0.0, -1.0}},
                                        .input_matrix = {{5.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                                        .output = {40.0, 1.0},
                                        .direct = {0.0, -40.0, -5.0}};
    drives.push_back(drive);
    drive.sampling = Sampling{.period = 1e-3};
    drives.push_back(drive);
  }
  return drives;
}

TEST(DriveModes, WhatFollowsItselfAloneIsWhatAListWouldShow) {
  for (const ReducedDrive& drive : signalled_drives()) {
    const hybrid::HybridSystem system = drive_system(drive).system;
    EXPECT_EQ(hybrid::PreparedSystem(system).exogenous(),
              hybrid::PreparedSystem(listed(system)).exogenous());
  }
}

TEST(DriveModes, SeenInAFrameTheyAreMadeOnDemandToo) {
  const DriveSystem built = drive_system(full_drive(damped));
  MovingFrame frame{hybrid::Vector::Constant(built.at.size, 2.0),
                    hybrid::Vector::Constant(built.at.size, 0.5),
                    hybrid::Vector::Zero(built.at.size)};
  const hybrid::HybridSystem seen = seen_in(built.system, frame);
  EXPECT_EQ(seen.source.made(), 0U);
  const hybrid::HybridSystem expected = seen_in(listed(built.system), frame);
  for (std::size_t i = 0; i < seen.mode_count(); ++i) {
    EXPECT_EQ(seen.mode(i).flow.matrix, expected.mode(i).flow.matrix);
    EXPECT_EQ(seen.mode(i).flow.offset, expected.mode(i).flow.offset);
  }
}

}  // namespace
}  // namespace gearlash::drive::drive_modes_test
