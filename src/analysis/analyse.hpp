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

/// What a drive is to the closed form once its signals stay where they end.
struct FinalServo {
  ClosedFormServo closed_form{};
  Drivetrain drivetrain{};
  /// K, N m/rad; not known of a normal form with a natural frequency.
  std::optional<double> stiffness{};
};
/// Nothing where the general engine must answer. Precondition: the drive is sound.
std::optional<FinalServo> final_servo(const Drive& drive);
/// The drive without its signals, where the closed form then answers for it: hunting does not
/// depend on where a reference stays in the end. Nothing for any other drive. Precondition: it is
/// sound.
std::optional<Drive> closed_form_drive(Drive drive);

/// The answer to a servo in the normal form, in SI. `stiffness`: K, N m/rad; where it is not known
/// there are no energies. Proved bounds, which need the error of the data, are left out.
Answer answer_of(const LimitCycleAnalysis& analysis, const ClosedFormServo& servo,
                 std::optional<double> stiffness);

/// The answer that a search amounts to. `reduced`: the drive that was searched.
Answer answer_of(const drive::AttractorSearch& search, const drive::ReducedDrive& reduced);

}  // namespace gearlash
