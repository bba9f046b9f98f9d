// How complete the search for cycles with bounces is: random servos, beside dense scans.
//   search_completeness [SERVOS [SEED]]   (100 servos each of restitution 0.3, 0.6 and 0.9, seed 7)

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "closed_form/energy_balance.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/limit_cycle.hpp"
#include "dense_search.hpp"

namespace {

using namespace gearlash;
using namespace gearlash::benchmarks;

/// Damping log-uniform 0.03 … 0.8, inertia ratio log-uniform 0.1 … 10, friction ratio uniform 0.03
/// … 0.97; only servos that may hunt and of which small motion does not die quickly.
NormalizedServo random_servo(std::mt19937_64& engine, double restitution) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11), -53);
  };
  const auto log_uniform = [&](double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  };
  while (true) {
    NormalizedServo servo;
    servo.damping = log_uniform(0.03, 0.8);
    servo.inertia_ratio = log_uniform(0.1, 10.0);
    servo.friction_ratio = uniform(0.03, 0.97);
    servo.backlash = 0.3;
    servo.restitution = restitution;
    if (!is_dissipative(servo) && growth_at_rest(servo_dynamics(servo)) >= 0.8) return servo;
  }
}

enum Kind { stable, unstable_symmetric, unstable_asymmetric, unstable_longer, kinds };
constexpr std::array<const char*, kinds> names = {"stable", "unstable, symmetric",
                                                  "unstable, asymmetric", "unstable, longer"};

Kind kind_of(const DenseCycle& cycle) {
  if (cycle.stable) return stable;
  return cycle.visited.size() == 1   ? unstable_symmetric
         : cycle.visited.size() == 2 ? unstable_asymmetric
                                     : unstable_longer;
}

struct Score {
  std::array<int, kinds> known{};   ///< by the dense scan
  std::array<int, kinds> missed{};  ///< of them, by the search
  int listed = 0;                   ///< by the search
  std::vector<double> milliseconds;
};

/// The arrival before LimitCycle::start.
Arrival arrival_of(const NormalizedServo& servo, const LimitCycle& cycle) {
  const double gap_speed = cycle.start.gap_speed();
  const double momentum_speed =
      cycle.start.load_speed + servo_dynamics(servo).motor_inertia * gap_speed;
  return {cycle.start.load_position, momentum_speed, -gap_speed / servo.restitution};
}

void score_servo(const NormalizedServo& servo, const Density& density, Score& score) {
  using clock = std::chrono::steady_clock;
  const auto begin = clock::now();
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  score.milliseconds.push_back(
      std::chrono::duration<double, std::milli>(clock::now() - begin).count());
  score.listed += static_cast<int>(analysis.cycles.size());
  for (const DenseCycle& cycle : dense_cycles(servo, density)) {
    constexpr double same = 1e-6;
    const bool listed =
        std::any_of(analysis.cycles.begin(), analysis.cycles.end(), [&](const LimitCycle& found) {
          return cycle.distance_to(arrival_of(servo, found)) < same;
        });
    ++score.known[kind_of(cycle)];
    if (!listed) ++score.missed[kind_of(cycle)];
  }
}

void print(double restitution, Score& score) {
  std::sort(score.milliseconds.begin(), score.milliseconds.end());
  double sum = 0.0;
  for (const double time : score.milliseconds) sum += time;
  const std::size_t count = score.milliseconds.size();
  std::printf("| %.1f | %zu | %.2f | %.2f |", restitution, count, score.milliseconds[count / 2],
              sum / static_cast<double>(count));
  for (int kind = 0; kind < kinds; ++kind) {
    const auto k = static_cast<std::size_t>(kind);
    std::printf(" %d of %d |", score.missed[k], score.known[k]);
  }
  std::printf(" %d |\n", score.listed);
}

}  // namespace

int main(int argc, char** argv) {
  const int servos = argc > 1 ? std::atoi(argv[1]) : 100;
  const int seed = argc > 2 ? std::atoi(argv[2]) : 7;
  std::printf("seed %d\n\n| restitution | servos | ms, median | ms, mean |", seed);
  for (const char* name : names) std::printf(" missed: %s |", name);
  std::printf(" listed |\n|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const double restitution : {0.3, 0.6, 0.9}) {
    std::mt19937_64 engine(static_cast<unsigned>(seed));
    const Density density = restitution > 0.8
                                ? Density{.points = 20'000, .starts = 128, .traversals = 2000}
                                : Density{};
    Score score;
    for (int i = 0; i < servos; ++i) {
      score_servo(random_servo(engine, restitution), density, score);
    }
    print(restitution, score);
  }
}
