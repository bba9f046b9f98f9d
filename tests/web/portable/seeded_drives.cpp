#include "seeded_drives.hpp"

#include <array>
#include <string>

#include "drive_lines.hpp"
#include "portable_answers.hpp"
#include "portable_draws.hpp"

namespace gearlash::portable {
namespace {

Contact drawn_contact(PortableDraws& draws) {
  const double kind = draws.uniform(0.0, 1.0);
  const double restitution = draws.uniform(0.05, 0.6);
  const double stiffness = draws.log_uniform(50.0, 1000.0);
  const double damping = draws.log_uniform(0.01, 0.3);
  if (kind < 0.5) return RigidContact{};
  if (kind < 0.7) return RigidContact{restitution};
  return CompliantContact{.stiffness = stiffness, .damping = damping};
}

struct Drawn {
  Drive drive;
  double sampling_period;
};

Drawn drawn(std::uint64_t seed) {
  PortableDraws draws(seed);
  Drive drive;
  drive.motor.kind = TorqueControl{};
  drive.motor.inertia = draws.log_uniform(1e-5, 4e-5);
  drive.motor.friction.viscous = draws.log_uniform(5e-6, 5e-5);
  drive.motor.friction.coulomb = draws.log_uniform(1e-4, 2e-3);
  drive.gearbox.ratio = 20.0;
  drive.gearbox.backlash = draws.log_uniform(5e-4, 1e-2);
  drive.load.inertia = draws.log_uniform(2e-3, 2e-2);
  drive.load.friction.viscous = draws.log_uniform(3e-4, 3e-3);
  drive.load.friction.coulomb = draws.log_uniform(5e-4, 1e-2);
  if (draws.happens(0.3)) {
    drive.load.friction.breakaway = PortableDraws::rounded(1.3 * drive.load.friction.coulomb);
  }
  drive.contact = drawn_contact(draws);
  drive.sensor.position = draws.happens(0.4) ? SensorPlace::motor : SensorPlace::load;
  const bool integrates = draws.happens(0.4);
  PID law{.terms = integrates ? PIDTerms::PID : PIDTerms::PD};
  law.proportional = draws.log_uniform(1.0, 10.0);
  law.derivative = draws.log_uniform(3e-3, 5e-2);
  const double integral = draws.log_uniform(1.0, 100.0);
  if (integrates) law.integral = integral;
  if (draws.happens(0.5)) law.filter = 1e-3;
  drive.controller.law = law;
  return {drive, draws.log_uniform(2e-3, 2e-2)};
}

// Seeds of drives that hunt, by contact and controller.
constexpr auto continuous_seeds =
    std::to_array<std::uint64_t>({114, 159, 189, 289, 109, 145,                 // plastic, PD
                                  28,  126, 204, 288, 106, 134, 318,            // bouncing, PD
                                  3,   223, 245, 315, 8,   34,  45,  120, 287,  // compliant, PD
                                  122, 129, 211, 216, 290, 130, 249,            // plastic, PID
                                  1,   212, 27,  97,  264, 268,                 // bouncing, PID
                                  214, 4,   95,                                 // compliant, PID
                                  46,  175, 230});  // the motor's sensor, PID
constexpr auto sampled_seeds =
    std::to_array<std::uint64_t>({28, 55, 56, 120, 171, 216, 239, 305, 325});
static_assert(continuous_seeds.size() + sampled_seeds.size() == 50);

}  // namespace

Drive continuous_drive(std::uint64_t seed) { return drawn(seed).drive; }

Drive sampled_drive(std::uint64_t seed) {
  auto [drive, period] = drawn(seed);
  PID& law = std::get<PID>(drive.controller.law);
  law.derivative_of_speed = true;
  law.filter = 0.0;
  drive.sampling = Sampling{.period = period, .speed_by_differences = false};
  return drive;
}

void print_drives() {
  for (const std::uint64_t seed : continuous_seeds) {
    print_drive("continuous-" + std::to_string(seed), continuous_drive(seed), Listed::all);
  }
  for (const std::uint64_t seed : sampled_seeds) {
    print_drive("sampled-" + std::to_string(seed), sampled_drive(seed), Listed::all);
  }
}

}  // namespace gearlash::portable
