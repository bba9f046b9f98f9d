// The question: what does this drive end in?
#pragma once

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

struct Wanted {
  /// Proofs by interval arithmetic where the closed form answers; else its verdict is computed
  /// only.
  bool proofs = true;
};

/// In closed form where the drive is the servo of 1960 by its physics; else by simulation from
/// several starts and shooting. Of references and load torques only the final value, ramp or sine
/// matters. A search that is stopped says so. Throws InvalidInput for a drive that is not sound.
[[nodiscard]] Answer analyse(const Drive& drive, const Wanted& wanted = {},
                             Progress& progress = no_progress());

}  // namespace gearlash
