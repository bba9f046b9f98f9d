// The automata of a drive, each of which adds its own transitions to a mode.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include "general/assemble/drive_forms.hpp"

namespace gearlash::drive {

// ---- transitions --------------------------------------------------------------------------------

hybrid::Transition transition(std::string name, const hybrid::AffineForm& guard,
                              hybrid::Direction direction, std::size_t target);

/// Direction in which a form that is positive (`way` = +1) or negative (−1) loses its sign.
inline hybrid::Direction falling_on(double way) {
  return way > 0.0 ? hybrid::Direction::falling : hybrid::Direction::rising;
}
/// Direction in which it gains that sign.
inline hybrid::Direction rising_on(double way) {
  return way > 0.0 ? hybrid::Direction::rising : hybrid::Direction::falling;
}

/// A form, beyond or within ± a number.
struct BranchEdge {
  hybrid::AffineForm form;
  double size;
};
/// From the inner branch to an outer one beyond `begins`, and back within `ends`. `names`: of the
/// events forward, backward and inwards.
void add_branches(const DriveForms& forms, const DriveMode& mode, Branch DriveMode::*automaton,
                  const BranchEdge& begins, const BranchEdge& ends,
                  const std::array<const char*, 3>& names, hybrid::AffineMode& built);

/// A reset that sets speeds to exactly 0.
hybrid::AffineReset stopped(const DriveForms& forms, std::initializer_list<Eigen::Index> speeds);

// ---- contact ------------------------------------------------------------------------------------

/// Rigid faces that are apart: impacts, and the end of infinite sequences of bounces.
void add_impacts(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);
/// Rigid faces together: parting, and stopping and breaking away as one.
void add_engaged(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);
/// Compliant faces: meeting, parting, and the limits of their damping.
void add_compliance(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);

// ---- friction -----------------------------------------------------------------------------------

/// A shaft that moves independently of the other: stopping and breaking away.
void add_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                  hybrid::AffineMode& built);
/// Passing the speed from which on a moving shaft's dry friction no longer falls.
void add_falling_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                          hybrid::AffineMode& built);

// ---- actuator -----------------------------------------------------------------------------------

/// For a continuous controller. A sampled one reaches the limit at its ticks.
void add_torque_limit(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);

/// The largest current of a winding. With a lag its torque stays at the limit while what it tends
/// to is beyond.
void add_current_limit(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);

// ---- controller ---------------------------------------------------------------------------------

/// The branches of ReducedDrive::error_shape, of a continuous controller.
void add_error_shape(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);
/// A sampled controller reads the error that it keeps, and takes the branches of its shape.
void add_error_reading(const DriveForms& forms, std::size_t clock, const DriveMode& mode,
                       hybrid::AffineMode& built);
/// The branch at a start, where it is not the inner one: a relay with two levels has none.
Branch first_branch(const ErrorShape& shape, double input);

/// Signs of the reference's speed.
void add_feedforward(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);
/// The signs at time 0, where all numbers are `start`.
DriveMode first_feedforward(const DriveForms& forms, const hybrid::Vector& start);
/// The sign after the reference's course has changed.
std::vector<hybrid::Alternative> reference_speeds(const DriveForms& forms, const DriveMode& mode);

// ---- sensor -------------------------------------------------------------------------------------

/// Adds a multiple of a reading to the state after a tick. The reading is exact if `step` is 0.
void add_reading(hybrid::AffineReset& reset, const hybrid::AffineForm& measured, double step,
                 const hybrid::Vector& gain);

/// An encoder under a continuous controller.
void add_counting(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built);

/// Sets the encoders' first readings, as if the speeds had been the same before the start.
hybrid::AffineReset first_readings(const DriveForms& forms);

// ---- clocks -------------------------------------------------------------------------------------

/// Numbers of the state that a clock sets.
struct Setting {
  std::size_t clock;
  Eigen::Index at;
  Eigen::Index size;
  const char* name;
};

/// Signals change before the controller samples them.
struct DriveClocks {
  std::vector<hybrid::Clock> clocks;
  std::vector<Setting> settings;
  /// Index of a sampled controller's clock; its output's clock is the next. That of an error that
  /// is read before is the one before.
  std::size_t sample = 0;
};
DriveClocks drive_clocks(const DriveForms& forms);

void add_settings(const DriveForms& forms, const DriveClocks& clocks, const DriveMode& mode,
                  hybrid::AffineMode& built);

/// A sampled controller's ticks.
void add_sampling(const DriveForms& forms, const DriveClocks& clocks, const DriveMode& mode,
                  hybrid::AffineMode& built);

/// Whether the output of a sampled controller takes effect at ticks of its own.
bool gives_out_between_samples(const Sampling& sampling);

}  // namespace gearlash::drive
