// The question: what does this drive end in?
#pragma once

#include <functional>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"

namespace gearlash {

struct Wanted {
  /// Proofs by interval arithmetic where the closed form answers; else its verdict is computed
  /// only.
  bool proofs = true;
  /// Called with the share that is done; false stops a search, which then says so.
  std::function<bool(double share)> go_on{};
};

/// In closed form where the drive is the servo of 1960 by its physics; else by simulation from
/// several starts and shooting. Of references and load torques only the final value, ramp or sine
/// matters. Throws InvalidInput for a drive that is not sound.
[[nodiscard]] Answer analyse(const Drive& drive, const Wanted& wanted = {});

}  // namespace gearlash
