#include "gearlash/cycle/growth_at_rest.hpp"

#include <cmath>
#include <limits>

#include "gearlash/cycle/half_cycle_algebra.hpp"
#include "gearlash/motion/engaged_flow.hpp"
#include "gearlash/motion/phase.hpp"

namespace gearlash {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A gap that motion of order one cannot cross.
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

/// One engaged motion from contact to parting.
double plastic_growth(const ServoDynamics& dynamics) {
  const double contact_speed = dynamics.motor_inertia / dynamics.motor_friction;
  const double engaged_time =
      first_zero(dynamics.damping, mesh_torque(dynamics, -1.0, contact_speed),
                 mesh_torque_rate(dynamics, -1.0, contact_speed));
  if (std::isinf(engaged_time)) return 0.0;
  return growth_after_contact(dynamics, contact_speed, engaged_time);
}

/// The bounces followed one by one.
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
