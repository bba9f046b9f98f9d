// The question: does this drive hunt, and where do its motions end?
#pragma once

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

struct Wanted {
  /// Proofs by interval arithmetic where the closed form answers. Without them the verdict is only
  /// computed.
  bool proofs = true;
  /// The ceiling: Answer::ceiling.
  bool ceiling = false;
};

/// Uses the closed form if the drive is the servo of 1960 by its physics. Otherwise it simulates
/// from several starts and closes cycles by shooting. Only the final value, ramp or sine of a
/// reference or load torque matters. A search that was stopped reports it. Throws InvalidInput for
/// a faulty drive.
[[nodiscard]] Answer analyse(const Drive& drive, const Wanted& wanted = {},
                             Progress& progress = no_progress());

}  // namespace gearlash
