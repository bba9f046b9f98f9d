// The units in which results are told: those of the servo's author where they are known.
#pragma once

#include <optional>
#include <string>

#include "input/servo_file.hpp"

namespace gearlash {

/// With a natural frequency, times are in seconds and speeds in rad/s; without, times are
/// normalised (ω_n t, units of 1/ω_n) and speeds are per unit of that time. With a stiffness,
/// energies are in joules; without, in units of K rad². Angles are in radians everywhere but where
/// a person reads them, who finds `angle` first.
struct ReportUnits {
  std::optional<double> natural_frequency = std::nullopt;  ///< ω_n, rad/s
  std::optional<double> stiffness = std::nullopt;          ///< K, N m/rad
  AngleUnit angle = {};  ///< in which the author gave the backlash

  double time(double normalized) const { return normalized / natural_frequency.value_or(1.0); }
  double speed(double normalized) const { return normalized * natural_frequency.value_or(1.0); }
  double energy(double normalized) const { return normalized * stiffness.value_or(1.0); }
  double normalized_time(double time) const { return time * natural_frequency.value_or(1.0); }
  double normalized_speed(double speed) const { return speed / natural_frequency.value_or(1.0); }

  const char* time_unit() const { return natural_frequency ? "s" : "1/ω_n"; }
  const char* speed_unit() const { return natural_frequency ? "rad/s" : "rad ω_n"; }
  const char* energy_unit() const { return stiffness ? "J" : "K rad²"; }
};

ReportUnits report_units(const ServoFile& file);

/// What made a file: enough to make it again.
struct Provenance {
  std::string command = {};  ///< as it could be typed into a shell, on one line
  std::string version = {};  ///< of Gearlash
};

/// At most `digits` significant ones, for a person to read: "0.0814", "1.2e-05", "inf".
std::string significant(double value, int digits);

/// A change by this ratio: "+12.3 %", "−40 %", "×26".
std::string change_text(double ratio);

/// A size, the author's unit first: "±12.3 arcmin (0.00358 rad)", "±0.0814 rad (4.67°)".
std::string swing_text(double size, const AngleUnit& unit, int digits);

}  // namespace gearlash
