// The engaged flow and its zeros against their definitions in many digits.
#include "closed_form/engaged_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "base/references.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::engaged_flow_test {
namespace {

/// What one epsilon in the data can do: the rates times time enter exponentials and angles, so the
/// terms of the closed form carry (1 + rate t) epsilons each. Below ζ = 1 the two rates are one
/// complex pair of modulus 1.
struct Scale {
  double position;
  double speed;
};

Scale scale_of(const EngagedFlow& flow, double time) {
  const double zeta = flow.damping;
  const double p = std::abs(flow.position);
  const double v = std::abs(flow.speed);
  if (zeta < 1.0) {
    const double w = std::sqrt((1.0 - zeta) * (1.0 + zeta));
    const double size =
        (p + v) * std::exp(-zeta * time) * (1.0 + time) * (1.0 + std::min(time, 1.0 / w));
    return {size, size};
  }
  const double half_split = std::sqrt((zeta - 1.0) * (zeta + 1.0));
  const double fast = zeta + half_split;
  const double slow = 1.0 / fast;
  const double decay = std::exp(-slow * time) * (1.0 + slow * time);
  const double impulse = decay * std::min(time, 0.5 / half_split);
  const double fast_decay = std::exp(-fast * time) * (1.0 + fast * time);
  return {p * (decay + slow * impulse) + v * impulse,
          v * (fast_decay + slow * impulse) + p * impulse};
}

/// Measured at most 3; eight is what the dozen roundings of the closed form could add up to.
constexpr double flow_epsilons = 8.0;

/// Random states, states through critical damping from both sides, and long times.
TEST(OracleEngagedFlow, KeepsItsDigits) {
  for (const Reference& exact : References("closed_form", "engaged_motions")) {
    const EngagedFlow flow{exact.input("damping"), exact.input("position"), exact.input("speed")};
    const double time = exact.input("time");
    const EngagedFlow::State actual = flow.at(time);
    const Scale scale = scale_of(flow, time);
    EXPECT_LE(epsilons_of(actual.position, exact["end_position"], scale.position), flow_epsilons)
        << "damping " << flow.damping << " time " << time;
    EXPECT_LE(epsilons_of(actual.speed, exact["end_speed"], scale.speed), flow_epsilons)
        << "damping " << flow.damping << " time " << time;
  }
}

TEST(EdgeEngagedFlow, TimeZeroIsTheInitialStateExactly) {
  for (const double damping :
       {0.0, 0.3, std::nextafter(1.0, 0.0), 1.0, std::nextafter(1.0, 2.0), 3.0, 1000.0}) {
    const EngagedFlow::State state = EngagedFlow{damping, 0.3, -0.7}.at(0.0);
    EXPECT_EQ(state.position, 0.3) << damping;
    EXPECT_EQ(state.speed, -0.7) << damping;
  }
}

TEST(EdgeEngagedFlow, LongTimesDecay) {
  const EngagedFlow::State rest = EngagedFlow{0.5, 1.0, 1.0}.at(1e9);
  EXPECT_EQ(rest.position, 0.0);
  EXPECT_EQ(rest.speed, 0.0);
}

/// Random ones; on the zero, which is not counted; from tiny values; along the fast direction of an
/// overdamped servo, beyond which alone it has a zero; through critical damping from both sides.
/// `condition` says how far an epsilon of each response moves the zero.
TEST(OracleFirstZero, KeepsItsDigits) {
  for (const Reference& exact : References("closed_form", "first_zeros")) {
    const double zero =
        first_zero(exact.input("damping"), exact.input("value"), exact.input("slope"));
    EXPECT_LE(epsilons_of(zero, exact["zero"], zero + exact.input("condition")), 8.0)
        << "damping " << exact["damping"] << " value " << exact["value"] << " slope "
        << exact["slope"] << ": " << zero << " for " << exact["zero"];
  }
}

}  // namespace
}  // namespace gearlash::engaged_flow_test
