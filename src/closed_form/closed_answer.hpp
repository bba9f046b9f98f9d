// What the closed form says of a servo, as an answer, and of all servos of a box, as its bounds.
#pragma once

#include <optional>

#include "closed_form/cycle_bounds.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/answer.hpp"
#include "model/answer_bounds.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

/// In SI. `stiffness`: K, N m/rad; without it there are no energies. Proved bounds are left out,
/// because they need the error of the data.
Answer answer_of(const LimitCycleAnalysis& analysis, const ClosedFormServo& servo,
                 std::optional<double> stiffness);

/// What is proved of all drives of a box, by bound_cycles(), which takes the guess.
AnswerBounds bounds_of(const DriveBox& box, double guessed_flight_time);

/// The flight time of half a plastic cycle in units of 1/ω_n: a guess for boxes around the drive.
/// NaN if none is known.
double flight_time_of(const Answer& answer);

/// The answer of the same drive with another backlash: its motions are proportional to it. Without
/// energies. Precondition: an answer of the closed form, with a backlash.
Answer with_backlash(Answer answer, double backlash);

}  // namespace gearlash
