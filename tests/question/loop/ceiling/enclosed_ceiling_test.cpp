// The ceiling over boxes of parameters, against single drives within them and their motion.
#include "question/loop/ceiling/enclosed_ceiling.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "base/traced_draws.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "question/change/proved_values.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::enclosed_ceiling_test {
namespace {

using testing::HasSubstr;

Drive undriven_pd() {
  Drive drive = pd_drive();
  drive.motor.friction.viscous = 2e-4;
  return drive;
}

Drive pid_of_armature() {
  Drive drive = pd_drive();
  drive.motor = {.kind = ArmatureControl{.torque_constant = 0.05,
                                         .back_emf_constant = 0.05,
                                         .resistance = 2.0,
                                         .inductance = 1e-3},
                 .inertia = 2e-5,
                 .friction = {.viscous = 1e-5}};
  drive.controller.law = PID{.terms = PIDTerms::PID,
                             .proportional = 80.0,
                             .integral = 100.0,
                             .derivative = 2.0,
                             .filter = 5e-3};
  return drive;
}

Drive sampled_cascade() {
  Drive drive = undriven_pd();
  drive.controller.law = CascadeController{.position = 15.0, .speed = 0.03};
  drive.sensor.encoder.resolution = 1e-4;
  drive.sampling = Sampling{.period = 1e-3, .delay = 1e-3};
  return drive;
}

struct Case {
  const char* name;
  Drive drive;
  std::vector<std::string> paths;
  double share;  ///< each within ± this
};

std::vector<Case> cases() {
  return {{"servo",
           normal_form(0.19, 2.0, 0.1, 0.3),
           {"servo.damping", "servo.inertia_ratio", "servo.friction_ratio"},
           0.1},
          {"PD", undriven_pd(), {"load.inertia", "motor.coulomb", "gearbox.backlash"}, 0.1},
          {"ratio", undriven_pd(), {"gearbox.ratio", "controller.proportional"}, 0.03},
          {"armature", pid_of_armature(), {"motor.resistance", "motor.torque_constant"}, 0.01},
          {"cascade", sampled_cascade(), {"load.inertia"}, 0.01}};
}

std::vector<BoxSide> box_of(const Case& one) {
  std::vector<BoxSide> box;
  for (const std::string& path : one.paths) {
    const double value = get(one.drive, path);
    box.push_back({path, {value * (1.0 - one.share), value * (1.0 + one.share)}});
  }
  return box;
}

Drive drawn_from(const Drive& drive, const std::vector<BoxSide>& box, SeededDraws& draws) {
  Drive drawn = drive;
  for (const BoxSide& side : box) {
    // Ends now and then: the largest are often there.
    const double inside = draws.uniform(side.values.low, side.values.high);
    const double end = draws.one_of({side.values.low, side.values.high});
    set(drawn, side.path, draws.happens(0.3) ? end : inside);
  }
  return drawn;
}

TEST(PropertyEnclosedCeiling, NoDriveOfTheBoxIsAbove) {
  TracedDraws draws(42);
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const std::vector<BoxSide> box = box_of(one);
    for (const Quantity quantity : {Quantity::ceiling, Quantity::motor_ceiling}) {
      const EnclosedCeiling proved = enclosed_ceiling(
          one.drive, box, {.quantity = quantity, .most_evaluations = 200, .close = 0.0});
      ASSERT_TRUE(proved.bound) << proved.reason;
      ASSERT_GE(*proved.bound, *proved.largest);
      double largest = 0.0;
      for (int i = 0; i < 30; ++i) {
        const Ceiling ceiling = ceiling_of(reduce_settled(drawn_from(one.drive, box, draws)));
        const double value = quantity == Quantity::ceiling ? *ceiling.load : *ceiling.motor;
        ASSERT_LE(value, *proved.bound);
        largest = std::max(largest, value);
      }
      EXPECT_LE(*proved.bound, 4.0 * largest);
      EXPECT_GE(*proved.largest, 0.999 * largest);
      // A bound of the nominal drive alone would not do.
      if (one.share < 0.03) continue;
      const Ceiling nominal = ceiling_of(reduce_settled(one.drive));
      EXPECT_GT(largest, 1.001 * (quantity == Quantity::ceiling ? *nominal.load : *nominal.motor));
    }
  }
}

TEST(EdgeEnclosedCeiling, OfAPointItIsTheDrivesOwn) {
  const Drive drive = undriven_pd();
  const double inertia = get(drive, "load.inertia");
  const BoxSide side{"load.inertia", {inertia, inertia}};
  const EnclosedCeiling proved = enclosed_ceiling(drive, {&side, 1});
  EXPECT_EQ(proved.bound, ceiling_of(drive).load);
  EXPECT_EQ(proved.parts, 1U);
}

TEST(EdgeEnclosedCeiling, SaysWhyThereIsNone) {
  const auto reason = [](const Drive& drive, const BoxSide& side) {
    const EnclosedCeiling found = enclosed_ceiling(drive, {&side, 1}, {.most_evaluations = 50});
    EXPECT_FALSE(found.bound);
    EXPECT_FALSE(found.is_at_most(infinity));
    return found.reason;
  };
  EXPECT_EQ(reason(sampled_cascade(), {"sampling.period", {1e-3, 2e-3}}),
            "no proof over values of sampling.period is known");
  Drive sampled = sampled_cascade();
  std::get<CascadeController>(sampled.controller.law).filter = 1e-3;
  EXPECT_EQ(reason(sampled, {"controller.filter", {1e-3, 2e-3}}),
            "no proof over values of controller.filter is known");
  EXPECT_EQ(reason(pid_of_armature(), {"controller.integral", {0.0, 1.0}}),
            "a proof needs values of controller.integral above 0");
  EXPECT_THAT(reason(pid_of_armature(), {"controller.integral", {1.0, 1e5}}), HasSubstr("stable"));
  Drive damped = undriven_pd();
  damped.contact = CompliantContact{.stiffness = 100.0, .damping = 0.1};
  EXPECT_THAT(reason(damped, {"load.inertia", {4e-3, 6e-3}}), HasSubstr("damping"));
}

TEST(PropertyEnclosedCeiling, ATargetIsProvedOverTheValuesItSays) {
  TracedDraws draws(42);
  // The ceiling falls as the damping rises.
  const Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  const double limit = *ceiling_of(reduce_settled(drive)).load;
  Target target;
  target.require(Quantity::ceiling, {0.0, limit});
  EXPECT_TRUE(is_provable(target.limits[0]));
  const Bounds interval{0.1, 0.6};
  const IntervalProof proof = prove_target(drive, "servo.damping", interval, target, 1500);
  ASSERT_FALSE(proof.parts.empty()) << proof.reason;
  double width = 0.0;
  int beyond = 0;
  for (const Bounds& part : proof.parts) width += part.high - part.low;
  for (int i = 0; i < 100; ++i) {
    const double value = draws.uniform(interval.low, interval.high);
    Drive changed = drive;
    set(changed, "servo.damping", value);
    const bool keeps = *ceiling_of(reduce_settled(changed)).load <= limit;
    const bool is_proved = std::any_of(proof.parts.begin(), proof.parts.end(),
                                       [&](const Bounds& part) { return part.contains(value); });
    ASSERT_TRUE(keeps || !is_proved) << value;
    beyond += keeps ? 0 : 1;
  }
  EXPECT_GT(beyond, 5);
  EXPECT_GT(width, 0.99 * (interval.high - 0.19));
  EXPECT_GT(proof.boxes, 10U);
  EXPECT_FALSE(is_provable({Quantity::ceiling, {limit, 2.0 * limit}}));
  EXPECT_FALSE(is_provable({Quantity::amplitude, {0.0, limit}}));
}

}  // namespace
}  // namespace gearlash::enclosed_ceiling_test
