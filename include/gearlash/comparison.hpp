// Several drives side by side: what each does, its linear loop, and its step response.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/analyse.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

inline constexpr std::size_t most_compared_drives = 100;

struct NamedDrive {
  std::string name{};  ///< for people: a file, or the value of a parameter
  Drive drive{};       ///< to be compared
};

struct ComparisonOptions {
  /// rad, of the reference, other than 0; default that of the first drive.
  std::optional<double> step{};
  /// s, > 0; default twenty swings of each drive's own loop, or as many as the load needs to rise.
  std::optional<double> until{};
  std::size_t motion_bytes = Wanted{}.motion_bytes;  ///< as of Wanted, of each search
};

/// What is compared of one drive.
struct ComparedDrive {
  std::string name{};              ///< as given
  Drive drive{};                   ///< as given
  std::optional<Answer> answer{};  ///< empty if it was not reached when the work was stopped
  double encoder_step = 0.0;       ///< rad at the load; 0: exact
  /// N m/rad at the load: the controller's torque per error of the position, without what it
  /// integrates over time. Empty for relays, transfer functions and state-space controllers.
  std::optional<double> stiffness{};
};

/// The answers of analyse() with proofs, ceiling and linear loop, on all cores, in the order of the
/// drives. Answer::step is that of a step from rest; it is left out where the linear loop is not
/// stable. Throws InvalidInput for no drive, for more than most_compared_drives, for faulty
/// options, and with all faults of all drives, each located at the drive's name.
[[nodiscard]] std::vector<ComparedDrive> compare(const std::vector<NamedDrive>& drives,
                                                 const ComparisonOptions& options = {},
                                                 Progress& progress = no_progress());

}  // namespace gearlash
