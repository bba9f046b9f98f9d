// The question and its answer: the closed form where the drive is its servo, else a search.
#pragma once

#include <optional>

#include "closed_form/limit_cycle.hpp"
#include "gearlash/analyse.hpp"
#include "general/attractors/attractors.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

/// An answer with what its engine worked it out from, for pictures.
struct Analysis {
  Answer answer{};
  drive::ReducedDrive reduced{};           ///< with its signals settled
  std::optional<ClosedFormServo> servo{};  ///< of the closed form
  std::optional<LimitCycleAnalysis> closed{};
  std::optional<drive::AttractorSearch> search{};
};

/// What the drive ends in. Of references and load torques only the final value, ramp or sine
/// matters. Throws InvalidInput for a drive that is not sound.
Analysis analyse_in_full(const Drive& drive, const Wanted& wanted = {},
                         Progress& progress = no_progress());

/// The answer to a servo in the normal form, in SI. `stiffness`: K, N m/rad; where it is not known
/// there are no energies. Proved bounds, which need the error of the data, are left out.
Answer answer_of(const LimitCycleAnalysis& analysis, const ClosedFormServo& servo,
                 std::optional<double> stiffness);

/// The answer that a search amounts to. `reduced`: the drive that was searched.
Answer answer_of(const drive::AttractorSearch& search, const drive::ReducedDrive& reduced);

}  // namespace gearlash
