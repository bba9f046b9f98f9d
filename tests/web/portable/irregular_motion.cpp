// Drives and servos that hunt irregularly. Two builds follow such a motion alike for some swings
// only, and then agree in its kind and in the means of its swings.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "answer_line.hpp"
#include "drive_lines.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/motion.hpp"
#include "portable_answers.hpp"
#include "seeded_drives.hpp"

namespace gearlash::portable {
namespace {

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};

Spread spread_of(std::span<const double> values) {
  Spread spread;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) spread.mean += value / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / count);
  return spread;
}

/// How well the mean of all is known, from the means of twenty pieces: swings that follow each
/// other resemble each other, so that deviation/√n would be too little.
double uncertainty_of_mean(std::span<const double> values) {
  constexpr std::size_t pieces = 20;
  const std::size_t length = values.size() / pieces;
  std::vector<double> means;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    means.push_back(spread_of(values.subspan(piece * length, length)).mean);
  }
  return spread_of(means).deviation / std::sqrt(static_cast<double>(pieces));
}

struct Swings {
  std::vector<double> amplitudes;  ///< rad, the largest positions between passings of 0
  std::vector<double> periods;     ///< s, from one passing forward to the next
};

/// The load's swings about 0 from `from` on, by samples.
Swings swings_of(const Samples& samples, double from) {
  Swings swings;
  double largest = 0.0;
  double last_passing = 0.0;
  for (std::size_t i = 1; i < samples.time.size(); ++i) {
    const double before = samples.load_position[i - 1];
    const double now = samples.load_position[i];
    largest = std::max(largest, std::abs(before));
    if ((before < 0.0) == (now < 0.0)) continue;
    const double step = samples.time[i] - samples.time[i - 1];
    const double passing = samples.time[i - 1] + step * before / (before - now);
    if (samples.time[i] > from) {
      swings.amplitudes.push_back(largest);
      if (now >= 0.0 && last_passing > from) swings.periods.push_back(passing - last_passing);
    }
    largest = 0.0;
    if (now >= 0.0) last_passing = passing;
  }
  return swings;
}

/// A servo whose answer has an irregular motion, with the swings of a long one.
void print_irregular_servo(const std::string& name, const Drive& servo) {
  constexpr double settled = 500.0;  // s
  constexpr double until = 6500.0;   // s, about a thousand swings
  constexpr double every = 0.02;     // s
  const Answer answer = analyse(servo, {.proofs = false});
  const Motion motion = simulate(servo, {.until = until, .start = Start{.load_position = 0.1}});
  const Swings swings = swings_of(motion.sampled(every), settled);
  const Spread amplitude = spread_of(swings.amplitudes);
  const Spread period = spread_of(swings.periods);
  AnswerLine line("swings", name);
  line.word("verdict", name_of(answer.verdict))
      .word("stop", name_of(motion.stop()))
      .word("irregular", std::to_string(answer.irregular.size()))
      .number("mean_amplitude", amplitude.mean, uncertainty_of_mean(swings.amplitudes))
      .number("mean_period", period.mean, uncertainty_of_mean(swings.periods));
  if (answer.irregular.empty()) return;
  line.number("amplitude", answer.irregular.front().amplitude, amplitude.deviation);
}

/// A constant load torque makes the general engine answer.
Drive loaded(Drive servo, double torque) {
  servo.load_torque = torque;
  return servo;
}

}  // namespace

void print_irregular() {
  constexpr double backlash = 0.3;
  const Drive lively = normal_form(0.19, 2.0, 0.1, backlash, 0.9);
  print_irregular_servo("restitution-0.9", lively);
  print_irregular_servo("restitution-0.6", normal_form(0.1, 1.0, 0.2, backlash, 0.6));
  const auto print = [](const std::string& name, const Drive& drive) {
    print_drive(name, drive, Listed::attractors);
  };
  print("loaded-0.9", loaded(lively, 0.002));
  print("loaded-0.85", loaded(normal_form(0.15, 0.4, 0.1, backlash, 0.85), 0.01));
  print("irregular-continuous-33", continuous_drive(33));
  print("irregular-sampled-37", sampled_drive(37));
  print("irregular-sampled-44", sampled_drive(44));
}

}  // namespace gearlash::portable
