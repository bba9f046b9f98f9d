// Derivatives of searched limit cycles: against the closed form, and against differences.
#include "question/change/orbit_derivatives.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "base/stopping.hpp"
#include "closed_form/drive_box.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/sensitivity.hpp"
#include "general/attractors/found_cycle.hpp"
#include "model/proportional_servo.hpp"
#include "question/change/derivatives.hpp"
#include "question/pd_drive.hpp"
#include "question/series/toleranced_samples.hpp"

namespace gearlash::searched_sensitivity_test {
namespace {

struct CheckedSensitivities {
  std::size_t drives = 0;        ///< drawn
  std::size_t cycles = 0;        ///< with derivatives
  std::size_t obstructed = 0;    ///< cycles without, of which the Jacobian says why
  std::size_t slopes = 0;        ///< compared
  std::size_t missing = 0;       ///< left out of a cycle without obstacle
  std::size_t incomparable = 0;  ///< numbers: however near, the cycle beside has other events
  /// Largest |slope − difference| over |slope| + |value/number|.
  double worst = 0.0;
  std::string where{};  ///< of the worst
};

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  /// Evenly in the logarithm.
  double number(double low, double high) {
    return low * std::pow(high / low, std::generate_canonical<double, 53>(random_));
  }
  bool coin() { return number(1.0, 4.0) < 2.0; }

 private:
  std::mt19937_64 random_;
};

constexpr std::array compared = {Quantity::amplitude, Quantity::motor_amplitude, Quantity::period};
using Values = std::array<double, compared.size()>;

Values values_of(const drive::FoundCycle& cycle) {
  return {cycle.amplitude, cycle.motor_amplitude, cycle.period()};
}

/// A drive with its largest stable cycle.
struct Hunting {
  const Drive& drive;
  drive::SearchSetting setting;
  drive::FoundCycle cycle;
};

/// The cycle of the drive with another value of a number, by Newton's method alone.
std::optional<drive::FoundCycle> cycle_beside(const Hunting& at, const std::string& path,
                                              double value) {
  Drive changed = at.drive;
  set(changed, path, value);
  if (!faults(changed).empty()) return std::nullopt;
  const drive::SearchSetting setting = drive::search_setting(reduce_settled(changed));
  const auto orbit = neighbouring_orbit(setting.system, at.cycle.orbit, at.setting.system);
  if (!orbit || orbit->events.size() != at.cycle.orbit.events.size()) return std::nullopt;
  return measured(setting, *orbit, {});
}

/// Central differences of fourth order; empty where a cycle beside the drive's has other events.
std::optional<Values> differences(const Hunting& at, const std::string& path, double present,
                                  double step) {
  Values sum{};
  for (const auto& [place, weight] :
       {std::pair{-2.0, 1.0}, {-1.0, -8.0}, {1.0, 8.0}, {2.0, -1.0}}) {
    const auto cycle = cycle_beside(at, path, present + place * step);
    if (!cycle) return std::nullopt;
    const Values values = values_of(*cycle);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * values[i] / (12.0 * step);
  }
  return sum;
}

/// Of ever smaller steps the differences that change least from one step to the next: larger ones
/// miss curvature, as near a grazing, and smaller ones lose digits.
std::optional<Values> best_differences(const Hunting& at, const std::string& path, double present) {
  std::optional<Values> last;
  std::optional<Values> best;
  Values least;
  least.fill(std::numeric_limits<double>::infinity());
  for (const double share : {3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6}) {
    const auto now = differences(at, path, present, share * std::abs(present));
    if (last && now) {
      if (!best) best = now;
      for (std::size_t i = 0; i < least.size(); ++i) {
        const double change = std::abs((*now)[i] - (*last)[i]);
        if (change >= least[i]) continue;
        least[i] = change;
        (*best)[i] = (*now)[i];
      }
    }
    last = now;
  }
  return best;
}

/// A breakaway that is not given follows Coulomb's torque, and cannot fall below it.
bool is_by_default(const std::string& path) {
  return path == "motor.breakaway" || path == "load.breakaway";
}

void compare(const Hunting& at, const Jacobian& jacobian, std::size_t parameter,
             CheckedSensitivities& found) {
  const std::string& path = jacobian.paths[parameter];
  const double present = jacobian.present[parameter];
  const auto exact = best_differences(at, path, present);
  if (!exact) {
    ++found.incomparable;
    return;
  }
  const Values values = values_of(at.cycle);
  for (std::size_t i = 0; i < compared.size(); ++i) {
    const auto row = std::find(jacobian.quantities.begin(), jacobian.quantities.end(), compared[i]);
    const auto slope =
        jacobian.slope(static_cast<std::size_t>(row - jacobian.quantities.begin()), parameter);
    if (!slope) {
      ++found.missing;
      continue;
    }
    ++found.slopes;
    const double error =
        std::abs(*slope - (*exact)[i]) / (std::abs(*slope) + std::abs(values[i] / present));
    if (error <= found.worst) continue;
    found.worst = error;
    found.where = std::string(name_of(compared[i])) + " by " + path;
  }
}

/// A motor under a continuous PD controller or a cascade, with random inertias, frictions, gap,
/// faces, gains and limit.
Drive random_continuous_drive(std::uint64_t seed) {
  Draws draw(seed);
  Drive drive;
  const double ratio = draw.number(5.0, 200.0);
  const double motor_inertia = draw.number(1e-6, 1e-3);
  const double load_inertia = motor_inertia * ratio * ratio * draw.number(0.2, 10.0);
  const double inertia = motor_inertia * ratio * ratio + load_inertia;  // at the load
  const double rate = draw.number(3.0, 100.0);                          // rad/s, of the loop
  const double stiffness = inertia * rate * rate / ratio;               // motor torque per load rad
  const double damping = 2.0 * draw.number(0.02, 0.4) * inertia * rate / ratio;
  const double gap = draw.number(1e-4, 1e-2);
  drive.motor = {.kind = TorqueControl{},
                 .inertia = motor_inertia,
                 .friction = {.viscous = 0.05 * damping / ratio,
                              .coulomb = stiffness * gap * draw.number(1e-3, 0.3)}};
  drive.gearbox = {.ratio = ratio, .backlash = gap};
  drive.load = {.inertia = load_inertia,
                .friction = {.viscous = 0.05 * damping * ratio,
                             .coulomb = ratio * stiffness * gap * draw.number(1e-3, 0.3)}};
  if (draw.coin()) {
    const double frequency = rate * draw.number(5.0, 30.0);
    const double alone = load_inertia * motor_inertia * ratio * ratio / inertia;
    drive.contact = CompliantContact{.stiffness = alone * frequency * frequency,
                                     .damping = 0.1 * alone * frequency};
  } else {
    drive.contact = RigidContact{};
  }
  if (draw.coin()) drive.motor.limit = stiffness * gap * draw.number(3.0, 100.0);
  drive.sensor.position = SensorPlace::load;
  if (draw.coin()) {
    drive.controller.law = PID{.terms = PIDTerms::PD,
                               .proportional = stiffness,
                               .derivative = damping,
                               .filter = draw.number(0.01, 0.2) / rate};
  } else {
    drive.controller.law = CascadeController{.position = stiffness / (damping * 3.0),
                                             .speed = damping * 3.0,
                                             .speed_integral = 0.0,
                                             .filter = draw.number(0.01, 0.2) / rate};
  }
  return drive;
}

/// GEARLASH_CYCLES=300 asks for more (docs/explanation/verification.md).
TEST(PropertySearchedSensitivity, AgreesWithDifferencesOfTheCycles) {
  const char* asked = std::getenv("GEARLASH_CYCLES");
  const std::size_t cycles = asked != nullptr ? static_cast<std::size_t>(std::atoi(asked)) : 3;
  std::uint64_t seed = 11;
  CheckedSensitivities found;
  for (; found.cycles < cycles && seed < 11 + 50 * cycles; ++seed) {
    const Drive drawn = random_continuous_drive(seed);
    const Analysis analysis = analyse_in_full(drawn, {.borders = false});
    const Cycle* cycle = analysis.answer.largest_stable();
    if (cycle == nullptr || !analysis.search) continue;
    const Jacobian jacobian = sensitivities(drawn, analysis);
    if (!jacobian.reason.empty()) continue;
    ++found.cycles;
    const auto index = static_cast<std::size_t>(cycle - analysis.answer.cycles.data());
    const Hunting at{drawn, drive::search_setting(analysis.reduced),
                     analysis.search->cycles[index]};
    const double before = found.worst;
    for (std::size_t parameter = 0; parameter < jacobian.paths.size(); ++parameter) {
      if (is_by_default(jacobian.paths[parameter])) continue;
      compare(at, jacobian, parameter, found);
    }
    if (found.worst > before) found.where += ", seed " + std::to_string(seed);
  }
  EXPECT_EQ(found.cycles, cycles);
  EXPECT_GT(found.slopes, 25 * cycles);
  EXPECT_LE(found.missing, found.slopes / 50);  // next to a grazing no two steps agree
  EXPECT_LT(found.worst, 1e-7) << found.where;
  RecordProperty("slopes", static_cast<int>(found.slopes));
  RecordProperty("worst", std::to_string(found.worst * 1e6) + "e-6");
}

/// A servo with a closed form, searched as if it had none.
TEST(OracleSearchedSensitivity, OfAServoIsThatOfItsClosedForm) {
  const Drive drive = sample_data_sheet();
  ASSERT_TRUE(settled_servo(drive));
  Analysis analysis;
  analysis.reduced = reduce_settled(drive);
  analysis.search = drive::find_attractors(analysis.reduced);
  analysis.answer = answer_of(*analysis.search, analysis.reduced);
  const std::array quantities = {Quantity::amplitude, Quantity::period, Quantity::frequency};
  const std::vector<std::string> paths = {
      "motor.inertia", "motor.friction", "gearbox.ratio",          "gearbox.backlash",
      "load.inertia",  "load.friction",  "controller.proportional"};
  const Jacobian found = orbit_derivatives(drive, analysis, quantities, paths);
  const Jacobian exact =
      derivatives(drive, quantities, std::vector<std::string_view>(paths.begin(), paths.end()));
  ASSERT_EQ(found.reason, "");
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    for (std::size_t j = 0; j < paths.size(); ++j) {
      const double scale =
          std::max(std::abs(*exact.slope(i, j)), *exact.values[i] / exact.present[j]);
      EXPECT_NEAR(found.slope(i, j).value(), *exact.slope(i, j), 1e-9 * scale) << paths[j];
    }
  }
}

TEST(SearchedSensitivity, KnowsTheScalesOfTorqueTimeAndAngle) {
  // All torques, inertias and gains times s change nothing; so do all angles: the amplitude follows
  // the gap with the dry frictions, which keep their share of the stiffness times the gap.
  Drive drive = pd_drive();
  drive.controller.law =
      PID{.terms = PIDTerms::PD, .proportional = 20.0, .derivative = 0.02, .filter = 1e-3};
  const std::vector<std::string_view> paths = {
      "motor.inertia",           "load.inertia",          "motor.friction",
      "load.friction",           "motor.coulomb",         "load.coulomb",
      "controller.proportional", "controller.derivative", "gearbox.backlash"};
  const Jacobian found =
      derivatives(drive, std::vector<Quantity>{Quantity::amplitude, Quantity::period}, paths);
  ASSERT_EQ(found.reason, "");
  double of_torques = 0.0;
  for (std::size_t i = 0; i < 8; ++i) of_torques += found.elasticity(0, i).value();
  EXPECT_NEAR(of_torques, 0.0, 1e-9);
  const double of_angles = found.elasticity(0, 8).value() + found.elasticity(0, 4).value() +
                           found.elasticity(0, 5).value();
  EXPECT_NEAR(of_angles, 1.0, 1e-9);
  EXPECT_NEAR(found.elasticity(1, 8).value() + found.elasticity(1, 4).value() +
                  found.elasticity(1, 5).value(),
              0.0, 1e-9);
}

TEST(EdgeSearchedSensitivity, LacksTheSlopesByTheNumbersAfterAStop) {
  Drive drive = pd_drive();
  drive.controller.law =
      PID{.terms = PIDTerms::PD, .proportional = 20.0, .derivative = 0.02, .filter = 1e-3};
  const Analysis analysis = analyse_in_full(drive, {.borders = false});
  test::Stopping impatient(2);
  const Jacobian found = orbit_derivatives(drive, analysis, std::array{Quantity::amplitude},
                                           {"load.inertia", "motor.inertia"}, impatient);
  EXPECT_TRUE(found.slope(0, 0));
  EXPECT_FALSE(found.slope(0, 1));
}

TEST(EdgeSearchedSensitivity, SaysWhyThereIsNone) {
  Drive drive = pd_drive();
  const auto reason = [&] {
    return derivatives(drive, {Quantity::amplitude}, {"load.inertia"}).reason;
  };
  EXPECT_THAT(reason(), testing::HasSubstr("no limit cycle was found"));
  std::get<PID>(drive.controller.law).proportional = 20.0;
  EXPECT_EQ(reason(), "");
  drive.contact = RigidContact{.restitution = 0.3};
  EXPECT_THAT(reason(), testing::HasSubstr("bounces settle"));
  drive.contact = RigidContact{};
  drive.sensor.encoder.resolution = 1e-6;
  EXPECT_THAT(reason(),
              testing::AnyOf(testing::HasSubstr("encoder"), testing::HasSubstr("no limit cycle")));
  EXPECT_THROW(static_cast<void>(derivatives(drive, {Quantity::amplitude}, {"load.mass"})),
               InvalidInput);
  EXPECT_THROW(static_cast<void>(derivatives(drive, {Quantity::amplitude}, {"sensor.position"})),
               InvalidInput);
}

}  // namespace
}  // namespace gearlash::searched_sensitivity_test
