#include "closed_form/growth_at_rest.hpp"

#include <cmath>
#include <limits>

#include "base/special_numbers.hpp"
#include "closed_form/engaged_flow.hpp"
#include "closed_form/half_cycle_algebra.hpp"
#include "closed_form/phase.hpp"

namespace gearlash {
namespace {

/// Too wide for motion of order one to cross.
constexpr double wide_gap = 1e6;

/// The load at y = −1, at rest; the motor arrives from behind on the forward face.
GapState creeping_contact(const ServoDynamics& dynamics) {
  return {-1.0, 0.0, 0.5 * wide_gap, 1.0 / dynamics.motor_friction};
}

/// Where the load comes to rest if the gap never closes again.
double rest_position(const GapFlight& flight) {
  if (flight.load_speed == 0.0) return flight.load_position;
  return flight.load_position + flight.load_speed / flight.load_rate;
}

/// ζ ≥ 1. With p = (1 − λ₁/c)(1 − λ₁/D), the faces part again only if p < 0, after
///   t₁ = ln(1 + (λ₂ − λ₁)q)/(λ₂ − λ₁),  q = (J_M/c + J_L/D)/(−p),
/// and μ₀ = −p e^{−λ₁t₁}. Only p involves cancellation.
double overdamped_growth(const ServoDynamics& dynamics, double motor_time, double load_time) {
  const double split = 2.0 * std::sqrt((dynamics.damping - 1.0) * (dynamics.damping + 1.0));
  const double slow = 1.0 / (dynamics.damping + 0.5 * split);
  const double fall = -(1.0 - slow * motor_time) * (1.0 - slow * load_time);
  if (!(fall > 0.0)) return 0.0;
  const double quotient =
      (dynamics.motor_inertia * motor_time + dynamics.load_inertia * load_time) / fall;
  const double engaged_time = split > 0.0 ? std::log1p(split * quotient) / split : quotient;
  return fall * std::exp(-slow * engaged_time);
}

/// Growth over one engaged motion, from contact to parting.
double plastic_growth(const ServoDynamics& dynamics) {
  const double zeta = dynamics.damping;
  const double motor_time = 1.0 / dynamics.motor_rate;
  const double load_time = 1.0 / dynamics.load_rate;
  if (zeta >= 1.0) return overdamped_growth(dynamics, motor_time, load_time);
  const double frequency = std::sqrt((1.0 - zeta) * (1.0 + zeta));
  const double rising =
      rising_at_rest(zeta, dynamics.motor_inertia, dynamics.load_inertia, motor_time, load_time);
  // (r² − 2ζr + 1)/r² of a rate r.
  const auto form_of = [&](double time) {
    return std::pow(1.0 - zeta * time, 2) + std::pow(frequency * time, 2);
  };
  return std::sqrt(form_of(motor_time) * form_of(load_time)) *
         std::exp(-zeta * std::atan2(frequency, rising) / frequency);
}

/// Follows the bounces one by one.
double bouncing_growth(const ServoDynamics& dynamics) {
  constexpr int event_limit = 200'000;
  ServoDynamics wide = dynamics;
  wide.backlash = wide_gap;
  PhaseStart start = begin_phase(wide, creeping_contact(dynamics));
  Phase phase = start.phase;
  for (int event = 0; event < event_limit; ++event) {
    const PhaseEnd end = end_of_phase(wide, phase, infinity);
    if (phase.mode == Mode::separated && (!end.has_event || end.face == Face::backward)) {
      return std::abs(rest_position(phase.flight));
    }
    if (!end.has_event) return 0.0;
    phase = end.next;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double growth_at_rest(const ServoDynamics& dynamics) {
  if (dynamics.motor_friction == 0.0 || dynamics.load_friction == 0.0) return infinity;
  return dynamics.plastic_contact() ? plastic_growth(dynamics) : bouncing_growth(dynamics);
}

}  // namespace gearlash
