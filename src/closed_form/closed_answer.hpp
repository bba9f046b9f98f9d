// What the closed form says of a servo, as an answer, and of all servos of a box, as its bounds.
#pragma once

#include <optional>

#include "closed_form/cycle_bounds.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/answer.hpp"
#include "model/answer_bounds.hpp"
#include "model/proportional_servo.hpp"

namespace gearlash {

/// In SI, without proved bounds. Without a known stiffness there are no energies.
Answer answer_of(const LimitCycleAnalysis& analysis, const ProportionalServo& servo);
/// What analyse_limit_cycles() gives. Throws InvalidInput.
Answer answer_of(const ProportionalServo& servo);

/// An answer with what it was made of, for pictures.
struct ClosedAnswer {
  Answer answer{};
  LimitCycleAnalysis cycles{};  ///< in units of the normal form
};
/// `servo`: the drive's settled_servo(). Proofs, where wanted, are about the data that the servo's
/// numbers stand for. Throws InvalidInput.
ClosedAnswer closed_answer(const Drive& drive, const ProportionalServo& servo, bool proofs);

/// What is proved of all drives of a box, by bound_cycles(), which takes the guess.
AnswerBounds bounds_of(const DriveBox& box, double guessed_flight_time);

/// The flight time of half a plastic cycle in units of 1/ω_n: a guess for boxes around the drive.
/// NaN if none is known.
double flight_time_of(const Answer& answer);

}  // namespace gearlash
