// Settling times of random drives beside the same with a slightly larger gain: they go on from one
// to the next, but where a swing enters or leaves the band.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "gearlash/controller.hpp"
#include "gearlash/motion.hpp"
#include "model/reduced_drive.hpp"
#include "question/step_response.hpp"
#include "random_drive.hpp"

namespace gearlash::oracle::settling_time_test {
namespace {

/// The gain of the position, of a PID law or a cascade; nullptr of others.
double* gain_of(Drive& drive) {
  if (auto* law = std::get_if<PID>(&drive.controller.law)) return &law->proportional;
  if (auto* law = std::get_if<CascadeController>(&drive.controller.law)) return &law->position;
  return nullptr;
}

struct Response {
  StepResponse figures{};
  /// rad: the least distance of a turn or of the end from an edge of the band.
  double nearest_turn = 0.0;
};

Response response_of(Drive drive, double step, double band, double until) {
  drive.reference.reset();
  const drive::ReducedDrive reduced = reduce(drive);
  Response response{drive::step_response(reduced, step, band, until)};
  drive.reference = step;
  const Motion motion =
      simulate(drive, {.until = until, .start = Start{.gap = 0.5 * drive.gearbox.backlash}});
  constexpr double samples = 40'000.0;
  const std::vector<double> load = motion.sampled(until / samples).load_position;
  response.nearest_turn = band;
  const auto look = [&](double position) {
    const double off = std::abs(std::abs(position - step) - band);
    response.nearest_turn = std::min(response.nearest_turn, off);
  };
  for (std::size_t i = 1; i + 1 < load.size(); ++i) {
    const bool turns = (load[i] - load[i - 1]) * (load[i + 1] - load[i]) <= 0.0;
    if (turns) look(load[i]);
  }
  look(load.back());
  return response;
}

TEST(OracleSettlingTime, GoesOnWithTheGainButWhereASwingEntersOrLeavesTheBand) {
  constexpr double degree = 0.017453292519943295;
  constexpr double step = degree;
  constexpr double band = 2.0 / 60.0 * degree;
  constexpr double change = 1e-6;
  std::size_t compared = 0;
  std::size_t settled = 0;
  for (std::uint64_t seed = 1; compared < 200; ++seed) {
    Drive drive = seed % 3 == 0   ? frictionless_drive(seed)
                  : seed % 3 == 1 ? continuous_drive(seed)
                                  : random_drive(seed, DriveKind::without_integral);
    double* gain = gain_of(drive);
    if (gain == nullptr) continue;
    const double until = std::min(2.0, drive::usual_step_time(reduce_settled(drive)));
    const Response here = response_of(drive, step, band, until);
    *gain *= 1.0 + change;
    const Response beside = response_of(drive, step, band, until);
    ++compared;
    if (!here.figures.settling_time && !beside.figures.settling_time) continue;
    ++settled;
    // A swing passes an edge, or the end of the time that is judged does.
    constexpr double near = 1e-3;
    if (std::min(here.nearest_turn, beside.nearest_turn) < near * band) continue;
    const double late = 0.8 * until;
    const auto time = [&](const Response& one) { return one.figures.settling_time.value_or(late); };
    const double period = drive.sampling ? drive.sampling->period : 0.0;
    EXPECT_NEAR(time(here), time(beside), 1e-3 * time(here) + 2.0 * period) << "seed " << seed;
  }
  EXPECT_GT(settled, 40U);
}

}  // namespace
}  // namespace gearlash::oracle::settling_time_test
