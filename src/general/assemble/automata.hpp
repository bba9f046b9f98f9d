// The automata of a drive. Each adds its own transitions to a mode.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "general/assemble/drive_forms.hpp"

namespace gearlash::drive {

// ---- transitions --------------------------------------------------------------------------------

hybrid::Transition transition(const char* name, const hybrid::AffineForm& guard,
                              hybrid::Direction direction, std::size_t target);

/// Fires where a form that is positive (`way` +1), or negative (−1), loses its sign.
inline hybrid::Direction falling_on(double way) {
  return way > 0.0 ? hybrid::Direction::falling : hybrid::Direction::rising;
}
/// Fires where it gains that sign.
inline hybrid::Direction rising_on(double way) {
  return way > 0.0 ? hybrid::Direction::rising : hybrid::Direction::falling;
}

/// Sets speeds to exactly 0.
hybrid::Reset stopped(const DriveForms& forms, std::initializer_list<Eigen::Index> speeds);

// ---- contact ------------------------------------------------------------------------------------

/// Separated rigid faces: impacts, and the end of endless bounces.
void add_impacts(const DriveForms& forms, const DriveMode& mode, hybrid::Mode& built);
/// Engaged rigid faces: parting, and stopping and breaking away as one.
void add_engaged(const DriveForms& forms, const DriveMode& mode, hybrid::Mode& built);
/// Compliant faces: meeting, parting, and the limits of their damping.
void add_compliance(const DriveForms& forms, const DriveMode& mode, hybrid::Mode& built);

// ---- friction -----------------------------------------------------------------------------------

/// For a shaft that moves by itself: stopping and breaking away.
void add_friction(const DriveForms& forms, const DriveMode& mode, Side side, hybrid::Mode& built);

// ---- actuator -----------------------------------------------------------------------------------

/// For a continuous controller. A sampled one meets the limit at its ticks.
void add_torque_limit(const DriveForms& forms, const DriveMode& mode, hybrid::Mode& built);

// ---- sensor -------------------------------------------------------------------------------------

/// Adds a multiple of a reading to numbers of the state after a tick. The reading is exact if
/// `step` is 0.
void add_reading(hybrid::Reset& reset, const hybrid::AffineForm& measured, double step,
                 const hybrid::Vector& gain);

/// An encoder under a continuous controller.
void add_counting(const DriveForms& forms, const DriveMode& mode, hybrid::Mode& built);

/// The encoders' readings at the start, as if the speeds had been the same before.
hybrid::Reset first_readings(const DriveForms& forms);

// ---- clocks -------------------------------------------------------------------------------------

/// Numbers that a clock sets.
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
  std::size_t sample = 0;  ///< the clock of a sampled controller; that of its output follows
};
DriveClocks drive_clocks(const DriveForms& forms);

void add_settings(const DriveForms& forms, const DriveClocks& clocks, const DriveMode& mode,
                  hybrid::Mode& built);

/// A sampled controller's ticks.
void add_sampling(const DriveForms& forms, const DriveClocks& clocks, const DriveMode& mode,
                  hybrid::Mode& built);

/// Whether the output of a sampled controller takes force at ticks of its own.
bool gives_out_between_samples(const Sampling& sampling);

}  // namespace gearlash::drive
