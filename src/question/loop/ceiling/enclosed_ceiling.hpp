// The ceiling of every drive of a box of parameters: a production run, or an interval of a design.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"
#include "gearlash/quantity.hpp"
#include "model/enclosed_drive.hpp"

namespace gearlash {

/// A parameter that has any value between two, both included, whatever the others have.
struct BoxSide {
  std::string path{};
  Bounds values{};
};

/// Every drive of the box, by those at its corners; else a line that says why not.
///
/// Every number of a ReducedDrive, and of its controller as a linear one, is a monotone function of
/// each single parameter that is taken here, the others being fixed: a power, a share or a sum of
/// such terms (model/reduction.hpp, model/controller_forms.hpp). So its extremes over a box are at
/// corners. Not taken: what is no number, what changes the form of the loop where it becomes 0, the
/// times and the sampling of a computer and a filter in it, coefficients of transfer functions and
/// matrices, registers, signals, dead bands and compensations.
///
/// Precondition: sound corners, at most most_sides sides.
std::variant<EnclosedDrive, std::string> enclosed_drive(const Drive& drive,
                                                        std::span<const BoxSide> box);
inline constexpr std::size_t most_sides = 10;

/// Where a side is halved: by ratio if it is more than an octave.
double middle_of(const Bounds& side);

/// The effort of the proof.
struct CeilingSearch {
  Quantity quantity = Quantity::ceiling;  ///< or motor_ceiling, effort_ceiling
  std::size_t most_evaluations = 3000;    ///< of boxes, a fraction of a millisecond to some each
  /// Stops once the bound is this close to the largest ceiling of a drive that was found,
  /// relatively.
  double close = 0.05;
  /// Stops once the bound is at or below it, and once a drive above it is found.
  std::optional<double> limit{};
};

struct EnclosedCeiling {
  /// ≥ the quantity of every drive of the box, proved with outward rounding; empty where the
  /// evaluations did not suffice to bound every part, or no theorem applies.
  std::optional<double> bound{};
  std::string reason{};             ///< why there is no bound
  std::optional<double> largest{};  ///< of single drives, those at the corners and in the middle
  std::size_t parts = 0;            ///< the box was divided into
  std::size_t evaluations = 0;
  bool stopped = false;  ///< by Progress

  bool is_at_most(double limit) const { return bound && *bound <= limit; }
};

/// Divides the box where its interval bound is largest, until it is close enough. Evaluates on all
/// cores, with the same result for any number of them.
EnclosedCeiling enclosed_ceiling(const Drive& drive, std::span<const BoxSide> box,
                                 const CeilingSearch& search = {},
                                 Progress& progress = no_progress());

}  // namespace gearlash
