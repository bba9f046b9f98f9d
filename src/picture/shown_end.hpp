// The end of a motion, where it has settled into hunting or rest, for its enlargement.
#pragma once

#include <optional>
#include <vector>

#include "base/extent.hpp"
#include "picture/drawn_motion.hpp"

namespace gearlash {

/// Numbers of angles are in the picture's unit.
struct ShownEnd {
  double from = 0.0;    ///< s
  double period = 0.0;  ///< s, of the oscillation; 0: none
  Extent load;          ///< relative to the reference, from then on
  Extent motor;
  std::optional<double> reference;  ///< if it is constant from then on
  Extent load_third;                ///< relative to the reference, over the last third of the time
  Extent motor_third;

  /// Of both shafts. The reference is included unless it is far away.
  Bounds shown_errors() const;
};

/// The last three periods, at most the last third. `period` (s): that of the hunting, if it is
/// known, else 0; it is then the mean from one passing of the middle upwards to the next, of the
/// shaft that swings more.
ShownEnd end_of(const std::vector<DrawnPiece>& pieces, double end_time, double period);

/// Whether the end would be lost on the axes of the whole motion: it swings, or stands away from
/// the reference, by less than a fifth of all `positions` but visibly beside `gap`, or its periods
/// are short beside the whole time.
bool is_worth_enlarging(const ShownEnd& end, const Extent& positions, double gap, double end_time);

}  // namespace gearlash
