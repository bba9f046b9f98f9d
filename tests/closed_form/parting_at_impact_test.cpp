// The theorem of docs/explanation/servo.md speaks of motions that have parted cleanly once.
// Arbitrary starts may part at impacts first; here is how often in a row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "closed_form/trajectory.hpp"

namespace gearlash::parting_at_impact_test {
namespace {

constexpr unsigned seed = 1960;

class RandomStart {
 public:
  NormalizedServo servo() {
    return {.damping = uniform() * (uniform() < 0.3 ? 3.0 : 1.0),
            .inertia_ratio = std::pow(10.0, 8.0 * uniform() - 4.0),
            .friction_ratio = uniform(),
            .backlash = 1.0};
  }

  ServoState state() {
    const double scale = std::pow(10.0, 6.0 * uniform() - 3.0);
    const double load_position = scale * spread();
    return {.motor_position = load_position + uniform() - 0.5,
            .motor_speed = 10.0 * scale * spread(),
            .load_position = load_position,
            .load_speed = scale * spread()};
  }

 private:
  double uniform() { return std::uniform_real_distribution<>(0.0, 1.0)(engine_); }
  /// ±1, with a share that is far smaller than the others.
  double spread() { return (2.0 * uniform() - 1.0) * (uniform() < 0.3 ? 0.01 : 1.0); }

  std::mt19937_64 engine_{seed};
};

int longest_run_of_partings_at_impact(const Trajectory& trajectory) {
  int run = 0;
  int longest = 0;
  for (const Event& event : trajectory.events()) {
    const bool parted = event.kind == EventKind::impact && event.mode_after == Mode::separated;
    run = parted ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

TEST(PropertyPlasticContact, PartingAtImpactDoesNotPersist) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomStart random;
  int longest = 0;
  for (int i = 0; i < 100'000; ++i) {
    const NormalizedServo servo = random.servo();
    const Trajectory motion =
        simulate(servo, random.state(), {.until = 60.0, .reference = 0.0, .event_limit = 2000});
    longest = std::max(longest, longest_run_of_partings_at_impact(motion));
  }
  EXPECT_LE(longest, 2);
  EXPECT_GE(longest, 1);  // else the starts were too tame to show anything
}

}  // namespace
}  // namespace gearlash::parting_at_impact_test
