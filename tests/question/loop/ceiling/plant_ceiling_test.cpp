// Ceilings of drives with windings, gravity and springs, continuous and sampled, beside sums of the
// answers that Runge and Kutta's method gives.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/drive_count.hpp"
#include "base/seeded_draws.hpp"
#include "controllers.hpp"
#include "leaping_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"

namespace gearlash::plant_ceiling_test {
namespace {

using drive::ReducedDrive;

/// PD control, −proportional y − derivative v, of a drive with |gap| ≤ 1.
struct PDDrive {
  ReducedDrive drive{};
  double proportional = 1.0;
  double derivative = 0.0;
};

enum class Kind { winding, weighed, sprung, sprung_with_winding };

void draw_shafts(ReducedDrive& drive, double least_friction, SeededDraws& draws) {
  drive.motor = {draws.log_uniform(0.2, 1.0), {.viscous = draws.log_uniform(least_friction, 0.3)}};
  drive.load = {draws.log_uniform(0.2, 1.0), {.viscous = draws.log_uniform(least_friction, 0.3)}};
  drive.backlash = 2.0;
}

void draw_sensors(ReducedDrive& drive, SeededDraws& draws) {
  const double on_load = draws.one_of({0.0, 1.0});
  drive.sensing = {.load_share_of_position = on_load,
                   .load_share_of_speed = on_load == 0.0 ? 0.0 : draws.one_of({0.0, 1.0})};
}

void draw_controller(PDDrive& given, SeededDraws& draws) {
  given.proportional = draws.log_uniform(0.3, 1.0);
  given.derivative = draws.log_uniform(0.5, 1.0);
  given.drive.controller = at_load(PID{
      .terms = PIDTerms::PD, .proportional = given.proportional, .derivative = given.derivative});
}

PDDrive random_drive(SeededDraws& draws, Kind kind) {
  PDDrive random;
  ReducedDrive& drive = random.drive;
  draw_shafts(drive, 0.05, draws);
  draw_sensors(drive, draws);
  draw_controller(random, draws);
  if (kind == Kind::winding || kind == Kind::sprung_with_winding) {
    drive.winding = {.time_constant = draws.log_uniform(0.03, 0.6),
                     .back_emf = draws.log_uniform(0.02, 0.5)};
  }
  if (kind == Kind::weighed) drive.gravity.stiffness = draws.uniform(-0.15, 0.6);
  if (kind == Kind::sprung || kind == Kind::sprung_with_winding) {
    drive.contact = drive::CompliantContact{.stiffness = draws.log_uniform(3.0, 30.0)};
  }
  return random;
}

/// Σ|changes| of the load's position, of the motor's and of the effort after a leap of the gap
/// by 1.
struct Variation {
  double load = 0.0;
  double motor = 0.0;
  double late = 0.0;  ///< of the load's, in the last tenth of the time
};

/// Whether a sum is all but whole: else it bounds the ceiling from below alone.
bool has_ended(double late, double sum) { return late <= 1e-4 * sum; }

Variation variation_after_leap(const PDDrive& given) {
  constexpr double step = 2e-3;
  constexpr int steps = 150'000;
  LeapingDrive leaping(given.drive);
  const auto requested = [&](const LeapingDrive& drive) {
    return -given.proportional * drive.sensed_position() - given.derivative * drive.sensed_speed();
  };
  leaping.leap(1.0, given.derivative);
  Variation sum{std::abs(leaping.load_position()), std::abs(leaping.motor_position())};
  for (int i = 0; i < steps; ++i) {
    const double load = leaping.load_position();
    const double motor = leaping.motor_position();
    leaping.go_on(step, 1, requested);
    const double change = std::abs(leaping.load_position() - load);
    sum.load += change;
    if (10 * i > 9 * steps) sum.late += change;
    sum.motor += std::abs(leaping.motor_position() - motor);
  }
  return sum;
}

TEST(OracleCeilingOfPlants, IsTheVariationAfterALeapOfTheGap) {
  SeededDraws draws(20261126);
  for (const Kind kind : {Kind::winding, Kind::weighed, Kind::sprung, Kind::sprung_with_winding}) {
    int proved = 0;
    for (int i = 0; i < test::drive_count(24) / 4; ++i) {
      const PDDrive given = random_drive(draws, kind);
      const Ceiling ceiling = ceiling_of(given.drive);
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + ", case " +
                   std::to_string(i));
      if (!ceiling.load) continue;
      ++proved;
      const Variation sum = variation_after_leap(given);
      EXPECT_GE(*ceiling.load, sum.load * (1.0 - 1e-5));
      EXPECT_GE(*ceiling.motor, sum.motor * (1.0 - 1e-5));
      if (!has_ended(sum.late, sum.load)) continue;
      EXPECT_LE(*ceiling.load, sum.load * 1.001);
      EXPECT_LE(*ceiling.motor, sum.motor * 1.001);
    }
    EXPECT_GE(proved, 3) << static_cast<int>(kind);
  }
}

// ---- sampled ------------------------------------------------------------------------------------

/// A computer that runs the PD controller with speeds by differences; its torque is held.
class Computer {
 public:
  Computer(const PDDrive& given, bool gives_out_between, int waiting)
      : given_(given),
        gives_out_between_(gives_out_between),
        waiting_(static_cast<std::size_t>(waiting), 0.0) {}
  void tick(const LeapingDrive& drive) {
    const double counted = drive.counted_position();
    waiting_.push_back(-given_.proportional * drive.sensed_position() -
                       given_.derivative * (counted - last_) / given_.drive.sampling->period);
    last_ = counted;
    if (!gives_out_between_) give_out();
  }
  void give_out() {
    torque_ = waiting_.front();
    waiting_.erase(waiting_.begin());
  }
  double torque() const { return torque_; }

 private:
  PDDrive given_;
  bool gives_out_between_;
  std::vector<double> waiting_;
  double last_ = 0.0;
  double torque_ = 0.0;
};

/// The load's position at the start of each part of a tick, with a leap of the gap at part `leap`.
std::vector<double> answer_to_leap(const PDDrive& given, int leap, int parts, int ticks) {
  const double part = given.drive.sampling->period / parts;
  const drive::SplitDelay delay = drive::split_delay(*given.drive.sampling);
  const bool between = delay.rest > 0.0 && delay.rest < given.drive.sampling->period;
  const int gives_out = static_cast<int>(std::lround(delay.rest / part));
  const int waiting = delay.whole_periods + (delay.rest > 0.0 && !between ? 1 : 0);
  LeapingDrive drive(given.drive);
  Computer computer(given, between, waiting);
  std::vector<double> seen;
  for (int k = 0; k < parts * ticks; ++k) {
    if (k == leap) drive.leap(1.0);
    if (k % parts == 0) computer.tick(drive);
    if (between && k % parts == gives_out) computer.give_out();
    seen.push_back(drive.load_position());
    drive.go_on(part, 1, [&](const LeapingDrive&) { return computer.torque(); });
  }
  return seen;
}

/// The largest that a gap within ±1, constant over each part of a tick, can cause.
struct SummedAnswers {
  double all = 0.0;
  double late = 0.0;  ///< of the last tenth of the ticks
};

SummedAnswers summed_answers(const PDDrive& given, int parts, int ticks) {
  std::vector<std::vector<double>> answers;
  for (int leap = 0; leap < parts; ++leap) {
    answers.push_back(answer_to_leap(given, leap, parts, ticks));
  }
  SummedAnswers largest;
  for (int phase = 0; phase < parts; ++phase) {
    SummedAnswers sum;
    for (int leap = 0; leap < parts; ++leap) {
      for (int seen = phase; seen < parts * ticks; seen += parts) {
        if (seen < leap) continue;
        const auto k = static_cast<std::size_t>(seen);
        const auto part = static_cast<std::size_t>(leap);
        const auto period = static_cast<std::size_t>(parts);
        const double next = leap + 1 < parts ? answers[part + 1][k]
                            : seen >= parts  ? answers[0][k - period]
                                             : 0.0;
        const double change = std::abs(answers[part][k] - next);
        sum.all += change;
        if (10 * seen > 9 * parts * ticks) sum.late += change;
      }
    }
    if (sum.all > largest.all) largest = sum;
  }
  return largest;
}

/// Puts the controller into a computer with one of four delays.
void sample(PDDrive& given, SeededDraws& draws) {
  constexpr double period = 0.125;
  given.drive.sampling =
      Sampling{.period = period, .delay = period * draws.one_of({0.0, 0.5, 1.0, 1.25})};
}

/// Rigid faces, no winding and no weight.
TEST(OracleCeilingOfPlants, OfPlainOnesUnderAComputerIsTheSumOfTheAnswers) {
  SeededDraws draws(1960);
  int proved = 0;
  const int count = test::drive_count(12);
  for (int i = 0; i < count; ++i) {
    PDDrive given;
    draw_shafts(given.drive, 0.01, draws);
    draw_controller(given, draws);
    draw_sensors(given.drive, draws);
    sample(given, draws);
    const Ceiling ceiling = ceiling_of(given.drive);
    SCOPED_TRACE("case " + std::to_string(i));
    if (!ceiling.load) continue;
    ++proved;
    const SummedAnswers summed = summed_answers(given, 32, 800);
    EXPECT_GE(*ceiling.load, summed.all * (1.0 - 1e-9));
    if (has_ended(summed.late, summed.all)) {
      EXPECT_LE(*ceiling.load, summed.all * 1.02);
    }
  }
  EXPECT_GT(3 * proved, 2 * count);
}

TEST(OracleCeilingOfPlants, UnderAComputerIsTheSumOfTheAnswers) {
  SeededDraws draws(1960);
  for (const Kind kind : {Kind::winding, Kind::weighed, Kind::sprung, Kind::sprung_with_winding}) {
    int proved = 0;
    for (int i = 0; i < test::drive_count(16) / 4; ++i) {
      PDDrive given = random_drive(draws, kind);
      sample(given, draws);
      const Ceiling ceiling = ceiling_of(given.drive);
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + ", case " +
                   std::to_string(i));
      if (!ceiling.load) continue;
      ++proved;
      const SummedAnswers summed = summed_answers(given, 16, 1200);
      EXPECT_GE(*ceiling.load, summed.all * (1.0 - 1e-6));
      // A gap that is constant over the parts does a little less than a free one.
      if (has_ended(summed.late, summed.all)) {
        EXPECT_LE(*ceiling.load, summed.all * 1.05);
      }
    }
    EXPECT_GE(proved, 2) << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace gearlash::plant_ceiling_test
