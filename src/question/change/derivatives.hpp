// The derivatives of a limit cycle with respect to the parameters of its drive, by differences.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/sensitivity.hpp"
#include "numeric/differences.hpp"
#include "question/analyse.hpp"

namespace gearlash {

/// The quantities that have derivatives in closed form.
inline constexpr std::array differentiable = {Quantity::amplitude, Quantity::period,
                                              Quantity::frequency, Quantity::multiplier,
                                              Quantity::growth_at_rest};

/// What a drive answers for a value of one of its numbers, the motion in practice followed from the
/// present value; without a motion where that is lost.
using AnswerAt = std::function<Answer(double)>;

/// A Jacobian without slopes yet, of a drive with this answer.
Jacobian without_slopes(std::span<const Quantity> quantities, std::vector<std::string> paths,
                        std::vector<double> present, const Answer& answer);

/// Sets the slopes by one parameter of a Jacobian whose other members are set: differences() of the
/// answers. A center's errors are shares of the amplitude. An amplitude of 0 has no slope.
void set_slopes(Jacobian& jacobian, std::size_t parameter, const AnswerAt& answer_at,
                DifferenceSteps steps);

/// Derivatives of all quantities with respect to every parameter that enters the closed form; for a
/// normal form, with respect to usual_parameters(). Precondition: a closed form.
Jacobian drive_sensitivity(const Drive& drive);

/// The same of any drive whose analysis is known: of a searched one by orbit_derivatives(). Empty
/// at the very ends of a normal form's ranges, where rounding puts its drivetrain outside them.
Jacobian sensitivities(const Drive& drive, const Analysis& analysis,
                       Progress& progress = no_progress());

}  // namespace gearlash
