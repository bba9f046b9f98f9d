#include "closed_form/parting_scan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

constexpr double points_per_decade = 15.0;
constexpr double widest = 1e4;  // backlashes
constexpr double narrowest = 1e-4;

/// ∫|h| and ∫|h′| of the impulse response h of 1/(s² + 2ζs + 1). ζ < 1: h swings with the ratio q
/// from one half period to the next. ζ ≥ 1: h ≥ 0 and ∫h = 1; with h′ ≤ e^{−λ₂t} − λ₁h it rises to
/// no more than 1/λ₂, and ∫|h′| is twice that height.
struct ResponseNorms {
  double itself;
  double rate;
};

ResponseNorms response_norms(double damping) {
  if (damping >= 1.0) {
    const double fast = damping + std::sqrt((damping - 1.0) * (damping + 1.0));
    return {1.0, 2.0 / fast};
  }
  const double per_radian = damping / std::sqrt((1.0 - damping) * (1.0 + damping));
  const double lost = -std::expm1(-std::numbers::pi * per_radian);  // 1 − q
  return {(2.0 - lost) / lost, 2.0 * std::exp(-per_radian * std::acos(damping)) / lost};
}

double distance(const Arrival& from, const Traversal& to) {
  return to.arrives() ? (to.next - from).norm() / from.norm() : infinity;
}

/// Empty if the faces never close again.
struct Sampled {
  PartingSample sample;
  bool creeps = false;
};

std::optional<Sampled> sampled(TraversalBudget& budget, double growth_at_rest, double amplitude) {
  constexpr double far = 1.0;  // a motion that grows so much does not come back in the next one
  const Traversal first = budget.first_arrival(amplitude);
  if (!first.arrives()) return std::nullopt;
  const Traversal second = budget.traverse(first.next, Derivative::not_wanted);
  Sampled result{.sample = {.amplitude = amplitude,
                            .arrival = first.next,
                            .once = distance(first.next, second),
                            .twice = infinity,
                            .settles = second.settled && second.arrives(),
                            .next_amplitude = std::abs(second.parting_amplitude),
                            .impacts = second.settled ? 0 : second.impacts}};
  if (std::isinf(result.sample.once)) return result;
  result.creeps = grows_as_at_rest(budget.dynamics, growth_at_rest, first.next, second.next);
  if (!second.settled && result.sample.once < far && second.next(2) > 0.0) {
    result.sample.twice =
        distance(first.next, budget.traverse(second.next, Derivative::not_wanted));
  }
  return result;
}

/// The samples next to the grazing between two, by bisection; none if there is nothing to bracket.
void add_grazing(TraversalBudget& budget, double growth_at_rest, PartingSample above,
                 PartingSample below, std::vector<PartingSample>& samples) {
  constexpr double near = 0.2;
  constexpr int halvings = 6;
  if (above.impacts == below.impacts || !(std::min(above.once, below.once) < near)) return;
  const double outer = above.amplitude;
  const double inner = below.amplitude;
  for (int i = 0; i < halvings && !budget.cut_short; ++i) {
    const double middle = std::sqrt(above.amplitude * below.amplitude);
    const std::optional<Sampled> at = sampled(budget, growth_at_rest, middle);
    if (!at) break;
    (at->sample.impacts == above.impacts ? above : below) = at->sample;
  }
  above.by_grazing = below.by_grazing = true;
  if (above.amplitude < outer) samples.push_back(above);
  if (below.amplitude > inner) samples.push_back(below);
}

}  // namespace

double largest_lasting_parting(const ServoDynamics& dynamics) {
  if (dynamics.damping == 0.0) return infinity;
  const ResponseNorms norms = response_norms(dynamics.damping);
  const double coupling = std::abs(dynamics.torque_per_speed);
  const double position = dynamics.motor_inertia * (1.0 + norms.itself) + coupling * norms.rate;
  const double speed =
      coupling * (1.0 + norms.itself) +
      std::abs(dynamics.motor_inertia - 2.0 * dynamics.damping * dynamics.torque_per_speed) *
          norms.rate;
  return 0.5 * dynamics.backlash * std::hypot(position, speed);
}

bool grows_as_at_rest(const ServoDynamics& dynamics, double growth, const Arrival& arrival,
                      const Arrival& next) {
  constexpr double told_apart = 1e-9;
  constexpr double rounding = 1e-13;
  const auto creeps = [&](const Arrival& at) {
    const double creeping_speed = -at(0) / dynamics.motor_friction;
    const double load_speed = at(1) - dynamics.motor_inertia * at(2);
    return std::abs(at(2) - creeping_speed) <= rounding * creeping_speed &&
           std::abs(load_speed) <= rounding * std::abs(at(1));
  };
  return std::isfinite(growth) && std::abs(growth - 1.0) > told_apart && creeps(arrival) &&
         creeps(next) &&
         std::abs(next.norm() - growth * arrival.norm()) <= told_apart * next.norm();
}

PartingScan scan_partings(TraversalBudget& budget, double growth_at_rest) {
  const double backlash = budget.dynamics.backlash;
  const double top = std::clamp(largest_lasting_parting(budget.dynamics),
                                10.0 * narrowest * backlash, widest * backlash);
  const auto count = static_cast<std::size_t>(
      std::ceil(points_per_decade * std::log10(top / (narrowest * backlash))));
  const std::size_t reserve = budget.events_left / 2;
  std::vector<std::optional<PartingSample>> samples(count + 1);
  std::size_t end = samples.size();
  bool reaches_rest = false;
  // Coarsely first, then finer.
  const auto is_far = [&](std::size_t i) {
    constexpr double far = 0.75;
    return i < end && samples[i] && samples[i]->once > far;
  };
  for (const std::size_t offset : {0U, 4U, 2U, 6U, 1U, 3U, 5U, 7U}) {
    for (std::size_t i = offset; i < end; i += 8) {
      if (budget.cut_short || budget.events_left < reserve) break;
      const std::size_t spacing = offset % 4 == 0 ? 8 : offset % 2 == 0 ? 2 : 1;
      if (spacing < 8 && is_far(i - spacing) && is_far(i + spacing)) continue;
      const double amplitude = top * std::pow(10.0, -static_cast<double>(i) / points_per_decade);
      const std::optional<Sampled> at = sampled(budget, growth_at_rest, amplitude);
      if (!at) continue;
      samples[i] = at->sample;
      if (at->creeps) {
        reaches_rest = true;
        end = i + 1;
      }
    }
  }
  PartingScan scan{.samples = {}, .reaches_rest = reaches_rest};
  scan.samples.reserve(2 * end);
  for (std::size_t i = 0; i < end; ++i) {
    if (!samples[i]) continue;
    if (!scan.samples.empty()) {
      const PartingSample above = scan.samples.back();
      add_grazing(budget, growth_at_rest, above, *samples[i], scan.samples);
    }
    scan.samples.push_back(*samples[i]);
  }
  return scan;
}

}  // namespace gearlash
