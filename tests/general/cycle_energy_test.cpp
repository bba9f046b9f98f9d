// The balance of a cycle: it closes, it is the closed form's, and what is lost is what plain sums
// of the same motion say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "closed_form/limit_cycle.hpp"
#include "controllers.hpp"
#include "drives.hpp"
#include "general/attractors/attractors.hpp"

namespace gearlash::drive::cycle_energy_test {
namespace {

// ---- random cycles ------------------------------------------------------------------------------

class Draws {
 public:
  explicit Draws(unsigned seed) : random_(seed) {}
  double share() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double between(double low, double high) { return low * std::pow(high / low, share()); }
  bool one_in(double n) { return share() * n < 1.0; }

 private:
  std::mt19937 random_;
};

PID filtered_pid(Draws& draws, double integral) {
  return {.terms = PIDTerms::PID,
          .proportional = 1.0,
          .integral = integral,
          .derivative = draws.between(0.1, 0.6),
          .filter = 0.05};
}

ShaftFriction rubbing(Draws& draws, const ShaftFriction& viscous) {
  ShaftFriction friction = viscous;
  friction.coulomb = draws.between(1e-3, 0.05);
  friction.breakaway = friction.coulomb * (1.0 + draws.share());
  if (draws.one_in(2.0)) friction.stribeck_speed = draws.between(1e-3, 0.1);
  return friction;
}

/// What a drive has beside the servo of 1960.
struct Kind {
  const char* name;
  void (*add)(Draws& draws, ReducedDrive& drive);
};

void add_compliance(Draws& draws, ReducedDrive& drive, ContactDamping law) {
  drive.contact = CompliantContact{draws.between(30.0, 1e5), draws.between(0.1, 30.0), law};
}

constexpr Kind kinds[] = {
    {"servo of 1960", [](Draws&, ReducedDrive&) {}},
    {"bouncing",
     [](Draws& draws, ReducedDrive& drive) {
       drive.contact = RigidContact{0.1 + 0.6 * draws.share()};
     }},
    {"compliant, full damping",
     [](Draws& draws, ReducedDrive& drive) { add_compliance(draws, drive, ContactDamping::full); }},
    {"compliant, limited damping",
     [](Draws& draws, ReducedDrive& drive) {
       add_compliance(draws, drive, ContactDamping::limited);
     }},
    {"joined by a spring",
     [](Draws& draws, ReducedDrive& drive) {
       drive = {};
       drive.motor = {1.213,
                      {.viscous = 3.0, .coulomb = 4.0, .breakaway = draws.between(4.0, 6.0)}};
       drive.load = {draws.between(0.7, 1.4), {.viscous = 1.0}};
       drive.contact = CompliantContact{31e3, draws.between(2.0, 8.0)};
       drive.sensing.load_share_of_speed = 1.0;
       drive.controller = at_load(
           PID{.terms = PIDTerms::PID, .proportional = 5e3, .derivative = 150.0, .filter = 1e-3});
       drive.torque_limit = 140.0;
     }},
    {"dry friction",
     [](Draws& draws, ReducedDrive& drive) {
       drive.controller = at_load(filtered_pid(draws, draws.between(0.01, 0.2)));
       drive.contact = RigidContact{draws.one_in(2.0) ? 0.0 : 0.4};
       drive.motor.friction = rubbing(draws, drive.motor.friction);
       drive.load.friction = rubbing(draws, drive.load.friction);
     }},
    {"sampled",  // only what drives it locks it to the clock
     [](Draws& draws, ReducedDrive& drive) {
       const double period = draws.between(0.05, 0.3);
       const double ticks = std::round(draws.between(20.0, 60.0));
       drive.sampling = Sampling{.period = period, .delay = period * draws.share()};
       drive.load_torque = Sine{0.0, 0.3, 2.0 * std::numbers::pi / (ticks * period), 0.0};
     }},
    {"winding",
     [](Draws& draws, ReducedDrive& drive) {
       drive.winding = {.time_constant = draws.between(0.01, 0.3), .back_emf = 0.1 * draws.share()};
       if (draws.one_in(3.0)) drive.winding.torque_limit = draws.between(0.05, 1.0);
     }},
    {"current limit without lag",
     [](Draws& draws, ReducedDrive& drive) {
       drive.winding = {.back_emf = 0.5 * drive.motor.friction.viscous,
                        .torque_limit = draws.between(0.05, 0.5)};
     }},
    {"torque limit",
     [](Draws& draws, ReducedDrive& drive) {
       drive.controller = at_load(filtered_pid(draws, draws.between(0.01, 0.2)));
       drive.torque_limit = draws.between(0.02, 0.3);
     }},
    {"relay",
     [](Draws& draws, ReducedDrive& drive) {
       drive.controller = at_load(PID{.proportional = 0.2});
       const double begins = draws.between(0.003, 0.1);
       drive.error_shape = {.begins = begins,
                            .ends = (draws.one_in(2.0) ? -1.0 : 0.5) * begins,
                            .inner_gain = 0.0,
                            .outer_gain = 0.0,
                            .offset = 1.0,
                            .jumps = true};
     }},
    {"encoder", [](Draws& draws,
                   ReducedDrive& drive) { drive.sensing.resolution = draws.between(0.01, 0.2); }},
    {"sine of the reference",
     [](Draws& draws, ReducedDrive& drive) {
       drive.reference = Sine{0.1, draws.between(0.1, 1.0), draws.between(0.1, 1.0), 0.0};
     }},
    {"sine of the load torque",
     [](Draws& draws, ReducedDrive& drive) {
       drive.load_torque = Sine{0.02, draws.between(0.05, 0.5), draws.between(0.1, 1.0), 0.0};
     }},
    {"ramp against a load torque",
     [](Draws& draws, ReducedDrive& drive) {
       drive.controller = at_load(filtered_pid(draws, draws.between(0.01, 0.2)));
       drive.reference = Ramp{0.0, draws.between(0.01, 0.2)};
       drive.load_torque = 0.01 * draws.share();
     }},
    {"weight", [](Draws& draws, ReducedDrive& drive) {
       drive.gravity = {.torque = 0.0, .stiffness = draws.between(0.05, 0.5), .angle = 0.3};
       drive.load_torque = 0.05;
     }}};

TEST(PropertyCycleEnergy, WhatFeedsACycleIsWhatItLoses) {
  constexpr unsigned seed = 20261130;
  SCOPED_TRACE(seed);
  constexpr std::size_t wanted = 300;
  Draws draws(seed);
  std::size_t cycles = 0;
  std::map<std::string, std::size_t> of_kind;
  for (std::size_t i = 0; cycles < wanted && i < 10 * wanted; ++i) {
    const Kind& kind = kinds[i % std::size(kinds)];
    SCOPED_TRACE(testing::Message() << kind.name << ", drive " << i);
    ReducedDrive drive =
        servo_drive(draws.between(0.05, 0.4), draws.between(0.2, 10.0), 0.05 + 0.6 * draws.share());
    kind.add(draws, drive);
    const double gap = 0.5 * drive.backlash;
    const AttractorSearch found = find_attractors(
        drive, {.starts = {{gap, 0.0, 0.01, 0.0}, {0.45, 0.0, 0.3, 0.0}, {3.0, 0.0, 3.0, 0.0}},
                .swing_times = 60.0,
                .most_events = 5'000,
                .most_edges = 1});
    cycles += found.cycles.size();
    of_kind[kind.name] += found.cycles.size();
    for (const FoundCycle& cycle : found.cycles) {
      const EnergyBalance& energy = cycle.energy;
      EXPECT_GT(energy.lost(), 0.0);
      EXPECT_NEAR(energy.fed(), energy.lost(), 1e-6 * energy.lost());
    }
  }
  EXPECT_GE(cycles, wanted);
  for (const auto& [name, count] : of_kind) EXPECT_GE(count, 5U) << name;
}

// ---- beside others ------------------------------------------------------------------------------

TEST(OracleCycleEnergy, OfAServoIsTheClosedForms) {
  for (const double restitution : {0.0, 0.4}) {
    for (const double damping : {0.08, 0.14, 0.19}) {
      SCOPED_TRACE(testing::Message() << restitution << " " << damping);
      const LimitCycleAnalysis exact = analyse_limit_cycles({.damping = damping,
                                                             .inertia_ratio = 2.0,
                                                             .friction_ratio = 0.1,
                                                             .backlash = 0.3,
                                                             .restitution = restitution});
      const AttractorSearch found = find_attractors(servo_drive(damping, 2.0, 0.1, restitution));
      ASSERT_FALSE(exact.cycles.empty());
      ASSERT_FALSE(found.cycles.empty());
      const EnergyLost& wanted = exact.cycles.front().energy;
      const EnergyBalance& energy = found.cycles.front().energy;
      const double near = 1e-7 * wanted.total();
      EXPECT_NEAR(energy.motor, wanted.total(), near);
      EXPECT_NEAR(energy.motor_friction, wanted.motor_friction, near);
      EXPECT_NEAR(energy.load_friction, wanted.load_friction, near);
      EXPECT_NEAR(energy.impacts, wanted.impacts, near);
      EXPECT_EQ(energy.lost(), energy.motor_friction + energy.load_friction + energy.impacts);
      EXPECT_EQ(energy.load_torque, 0.0);
    }
  }
}

using Rate = double (*)(const ReducedDrive& drive, const ShaftStates& at);

/// ∫ of a power over a cycle, from event to event by Simpson's rule.
double summed(const ReducedDrive& drive, const hybrid::Trajectory& motion, Rate power) {
  constexpr int parts = 800;
  constexpr double aside = 1e-9;  // of a stretch, so that its ends are those within it
  double sum = 0.0;
  double from = motion.start_time();
  const auto add_until = [&](double to) {
    const double step = (1.0 - 2.0 * aside) * (to - from) / parts;
    const double begin = from + aside * (to - from);
    for (int i = 0; i <= parts; ++i) {
      const double weight = i == 0 || i == parts ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      sum += weight * step / 3.0 * power(drive, shafts_of(motion.at(begin + i * step)));
    }
    from = to;
  };
  for (const hybrid::Event& event : motion.events()) add_until(event.time);
  add_until(motion.end_time());
  return sum;
}

/// Momentum is kept: what is lost is that of the relative speed.
double lost_in_leaps(const ReducedDrive& drive, const hybrid::Trajectory& motion) {
  const double reduced =
      drive.motor.inertia * drive.load.inertia / (drive.motor.inertia + drive.load.inertia);
  double sum = 0.0;
  for (const hybrid::Event& event : motion.events()) {
    const ShaftStates before = shafts_of({event.mode, event.before});
    const ShaftStates after = shafts_of({event.mode_after, event.after});
    sum += 0.5 * reduced *
           (std::pow(before.motor_speed - before.load_speed, 2.0) -
            std::pow(after.motor_speed - after.load_speed, 2.0));
  }
  return sum;
}

double damping_power(const ReducedDrive& drive, const ShaftStates& at) {
  const auto& faces = std::get<CompliantContact>(drive.contact);
  const double gap = at.motor_position - at.load_position;
  const double twist = std::max(std::abs(gap) - 0.5 * drive.backlash, 0.0);
  const double speed = std::copysign(1.0, gap) * (at.motor_speed - at.load_speed);
  const double spring = faces.stiffness * twist;
  double damping = std::max(faces.damping * speed, -spring);
  if (faces.law == ContactDamping::limited) damping = std::min(damping, spring);
  return twist > 0.0 ? damping * speed : 0.0;
}

void expect_plain_sums(const ReducedDrive& drive) {
  const AttractorSearch found = find_attractors(drive);
  ASSERT_FALSE(found.cycles.empty());
  const FoundCycle& cycle = found.cycles.front();
  const double from = cycle.orbit.start_time;
  const auto motion =
      simulate(found.system, cycle.orbit.start, {.from = from, .until = from + cycle.period()});
  const EnergyBalance& energy = cycle.energy;
  const auto expect_near = [&](double booked, double plain, const char* what) {
    EXPECT_NEAR(booked, plain, 1e-5 * std::abs(plain) + 1e-12 * energy.lost()) << what;
  };
  const auto sum = [&](Rate power) { return summed(drive, motion, power); };
  expect_near(energy.motor_friction, sum([](const auto& of, const auto& at) {
                return of.motor.friction.viscous * at.motor_speed * at.motor_speed;
              }),
              "motor friction");
  expect_near(energy.load_friction, sum([](const auto& of, const auto& at) {
                return of.load.friction.viscous * at.load_speed * at.load_speed;
              }),
              "load friction");
  expect_near(energy.motor_dry_friction, sum([](const auto& of, const auto& at) {
                return of.motor.friction.coulomb * std::abs(at.motor_speed);
              }),
              "motor dry friction");
  expect_near(energy.load_dry_friction, sum([](const auto& of, const auto& at) {
                return of.load.friction.coulomb * std::abs(at.load_speed);
              }),
              "load dry friction");
  const bool is_rigid = std::holds_alternative<RigidContact>(drive.contact);
  expect_near(energy.impacts, is_rigid ? lost_in_leaps(drive, motion) : 0.0, "impacts");
  expect_near(energy.contact_damping, is_rigid ? 0.0 : sum(damping_power), "contact damping");
}

TEST(OracleCycleEnergy, IsThatOfPlainSumsOfPlasticFaces) {
  expect_plain_sums(servo_drive(0.19, 2.0, 0.1));
}

TEST(OracleCycleEnergy, IsThatOfPlainSumsOfBounces) {
  expect_plain_sums(servo_drive(0.12, 1.0, 0.2, 0.35));
}

TEST(OracleCycleEnergy, IsThatOfPlainSumsOfFacesWithLimitedDamping) {
  ReducedDrive drive = servo_drive(0.1, 2.0, 0.1);
  drive.contact = CompliantContact{200.0, 2.0, ContactDamping::limited};
  expect_plain_sums(drive);
}

TEST(OracleCycleEnergy, IsThatOfPlainSumsOfFacesWithFullDamping) {
  ReducedDrive drive = servo_drive(0.1, 2.0, 0.1);
  drive.contact = CompliantContact{200.0, 2.0, ContactDamping::full};
  expect_plain_sums(drive);
}

TEST(OracleCycleEnergy, IsThatOfPlainSumsOfDryFriction) {
  ReducedDrive drive = servo_drive(0.1, 2.0, 0.3, 0.3);
  drive.motor.friction.coulomb = 0.004;
  drive.motor.friction.breakaway = 0.006;
  drive.load.friction.coulomb = drive.load.friction.breakaway = 0.003;
  drive.winding = {.time_constant = 0.2, .back_emf = 0.02};
  expect_plain_sums(drive);
}

}  // namespace
}  // namespace gearlash::drive::cycle_energy_test
