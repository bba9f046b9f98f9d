// Servos with a closed form.
//
// The unit of a quantity Q is an ulp of its condition, in the sense of backward errors:
//   growth at rest       |Q| + S
//   amplitude, period    |Q| (1 + C) + S
//   multiplier m         m (1 + C) + 2 √m (1 + √m) + S
// S = Σ |p ∂Q/∂p| over damping, inertia ratio, friction ratio and, with bounces, restitution, by
// derivatives(): what a relative error of the data makes of Q. C = 1/|1 − m|: what an error of the
// half cycle makes of the cycle. 2 √m (1 + √m): m is the square of the slope of the half cycle's
// map, and this slope is 1 less a number of its size, so that it is known to ulps of 1 + √m.
//
// Both builds do the same operations, without fused ones. They differ in exp, log, sin and cos of
// their C libraries, and with bounces in the order in which matrix products are summed. Each of
// these functions is within about one ulp of the exact value, so two of them differ by two at most.
// What they return enters a formula as a decay, an angle or a position, where an ulp makes what an
// ulp of the data makes. A half cycle has some ten of them, and the search of its time ends within
// some ulps, in one build perhaps a step earlier. So a few units bound the difference.
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "answer_line.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/sensitivity.hpp"
#include "portable_answers.hpp"
#include "portable_draws.hpp"

namespace gearlash::portable {
namespace {

constexpr int count = 10'000;
constexpr int bouncing_every = 10;  ///< the closed form takes ten times as long with bounces
constexpr std::uint64_t seed = 1960;

constexpr std::array quantities = {Quantity::growth_at_rest, Quantity::amplitude, Quantity::period,
                                   Quantity::multiplier};

/// Σ |p ∂Q/∂p| of each quantity; 0 where there is no cycle.
std::array<double, quantities.size()> changes_with_data(const Drive& servo, bool bounces) {
  std::vector<std::string_view> paths = {"servo.damping", "servo.inertia_ratio",
                                         "servo.friction_ratio"};
  if (bounces) paths.emplace_back("contact.restitution");
  const Jacobian jacobian = derivatives(servo, quantities, paths);
  std::array<double, quantities.size()> sums{};
  for (std::size_t row = 0; row < sums.size(); ++row) {
    for (std::size_t column = 0; column < paths.size(); ++column) {
      const double slope = jacobian.slope(row, column).value_or(0.0);
      sums[row] += std::abs(slope * jacobian.present[column]);
    }
  }
  return sums;
}

void print_servo(int index, PortableDraws& draws) {
  const double damping = draws.log_uniform(0.01, 2.0);
  const double inertia_ratio = draws.log_uniform(0.05, 20.0);
  const double friction_ratio = draws.uniform(0.0, 1.0);
  const double bounce = draws.uniform(0.05, 0.5);
  const bool bounces = index % bouncing_every == 0;
  const double restitution = bounces ? bounce : 0.0;
  const Drive servo = normal_form(damping, inertia_ratio, friction_ratio, 1.0, restitution);
  const Answer answer = analyse(servo, {.proofs = false});
  const auto [of_growth, of_amplitude, of_period, of_multiplier] =
      changes_with_data(servo, bounces);

  AnswerLine line(bounces ? "bouncing-servo" : "servo", std::to_string(index));
  line.number("damping", damping)
      .number("inertia_ratio", inertia_ratio)
      .number("friction_ratio", friction_ratio)
      .number("restitution", restitution)
      .word("verdict", name_of(answer.verdict));
  const double growth = answer.growth_at_rest.value();
  line.number("growth", growth, ulp * (std::abs(growth) + of_growth));
  const Cycle* cycle = answer.largest_stable();
  if (cycle == nullptr) return;
  const double condition = condition_of_cycle(cycle->multiplier);
  const double slope = std::sqrt(cycle->multiplier);
  line.word("kind", name_of(cycle->kind))
      .number("amplitude", cycle->amplitude, ulp * (cycle->amplitude * condition + of_amplitude))
      .number("period", cycle->period, ulp * (cycle->period * condition + of_period))
      .number("multiplier", cycle->multiplier,
              ulp * (cycle->multiplier * condition + 2.0 * slope * (1.0 + slope) + of_multiplier));
}

}  // namespace

void print_servos() {
  PortableDraws draws(seed);
  for (int index = 0; index < count; ++index) print_servo(index, draws);
}

}  // namespace gearlash::portable
