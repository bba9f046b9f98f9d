#include "dense_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "numeric/linear_algebra.hpp"

namespace gearlash::benchmarks {
namespace {

constexpr std::size_t event_limit = 20'000;
constexpr int longest_on_line = 4;
constexpr int longest_of_motion = 8;

bool arrives(const Traversal& traversal) {
  return traversal.outcome == Traversal::Outcome::arrived;
}

std::optional<Arrival> next_of(const ServoDynamics& dynamics, const Arrival& arrival) {
  const Traversal next = traverse(dynamics, arrival, Derivative::not_wanted, event_limit);
  if (!arrives(next) || !(next.next(2) > 0.0)) return std::nullopt;
  return next.next;
}

struct Round {
  std::vector<Arrival> visited;
  Arrival end;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();

  double mismatch() const { return (end - visited.front()).norm() / visited.front().norm(); }
};

std::optional<Round> round_from(const ServoDynamics& dynamics, const Arrival& start, int order) {
  Round round{.visited = {}, .end = start};
  for (int i = 0; i < order; ++i) {
    if (!(round.end(2) > 0.0)) return std::nullopt;
    round.visited.push_back(round.end);
    const Traversal next = traverse(dynamics, round.end);
    if (!arrives(next)) return std::nullopt;
    round.end = next.next;
    round.slope = next.slope * round.slope;
  }
  return round;
}

/// Newton's method with steps halved until the mismatch falls.
std::optional<Round> recurring(const ServoDynamics& dynamics, const Arrival& start, int order) {
  constexpr int step_limit = 40;
  constexpr double converged = 1e-13;
  constexpr double acceptable = 1e-10;
  std::optional<Round> round = round_from(dynamics, start, order);
  for (int step = 0; round && step < step_limit && round->mismatch() > converged; ++step) {
    const Arrival from = round->visited.front();
    const Arrival full = solved_with_full_pivoting(
        Eigen::Matrix3d(round->slope - Eigen::Matrix3d::Identity()), Arrival(from - round->end));
    std::optional<Round> better;
    for (double share = 1.0; share > 1e-3 && !better; share *= 0.5) {
      const auto trial = round_from(dynamics, from + share * full, order);
      if (trial && trial->mismatch() < round->mismatch()) better = trial;
    }
    if (!better) break;
    round = better;
  }
  return round && round->mismatch() < acceptable ? round : std::nullopt;
}

class Finder {
 public:
  Finder(const NormalizedServo& servo, const Density& density)
      : backlash_(servo.backlash), dynamics_(servo_dynamics(servo)), density_(density) {}

  std::vector<DenseCycle> run() {
    scan_line();
    follow_motions();
    return cycles_;
  }

 private:
  double distance_to_known(const Arrival& arrival, bool only_stable) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const DenseCycle& cycle : cycles_) {
      if (cycle.stable || !only_stable) nearest = std::min(nearest, cycle.distance_to(arrival));
    }
    return nearest;
  }

  void try_from(const Arrival& start, int order) {
    constexpr double same = 1e-7;
    const std::optional<Round> round = recurring(dynamics_, start, order);
    if (!round) return;
    const Arrival& first = round->visited.front();
    for (int divisor = 1; divisor < order; ++divisor) {
      const Arrival& again = round->visited[static_cast<std::size_t>(divisor)];
      const bool repeats = order % divisor == 0 && (again - first).norm() < same * first.norm();
      if (repeats) return try_from(first, divisor);
    }
    // Where a multiplier is 1 to rounding, swings of any amplitude persist.
    const double isolation = least_pivot(round->slope - Eigen::Matrix3d::Identity());
    if (std::max(round->mismatch(), 1e-14) >= 1e-5 * isolation) return;
    if (distance_to_known(first, false) < same) return;
    cycles_.push_back({round->visited, eigenvalues(round->slope).cwiseAbs().maxCoeff() < 1.0});
  }

  void scan_line() {
    struct Point {
      Arrival arrival = Arrival::Zero();
      std::array<double, longest_on_line + 1> distance{};  // after so many traversals
    };
    const auto count = static_cast<std::size_t>(density_.points);
    std::vector<Point> points(count);
    for (std::size_t i = 0; i < count; ++i) {
      points[i].distance.fill(std::numeric_limits<double>::infinity());
      const double decade = -3.0 + 6.0 * static_cast<double>(i) / static_cast<double>(count - 1);
      const Traversal first = first_arrival(dynamics_, backlash_ * std::pow(10.0, decade));
      if (!arrives(first)) continue;
      points[i].arrival = first.next;
      std::optional<Arrival> at = first.next;
      for (std::size_t order = 1; order <= longest_on_line; ++order) {
        at = next_of(dynamics_, *at);
        if (!at) break;
        points[i].distance[order] = (*at - first.next).norm() / first.next.norm();
      }
    }
    constexpr int most_attempts = 400;
    for (int order = 1; order <= longest_on_line; ++order) {
      const auto k = static_cast<std::size_t>(order);
      const double near = order == 1 ? 0.5 : 0.3;
      int attempts = 0;
      for (std::size_t i = 1; i + 1 < count && attempts < most_attempts; ++i) {
        const double here = points[i].distance[k];
        const bool least = here <= points[i - 1].distance[k] && here <= points[i + 1].distance[k];
        if (!(here < near) || !least) continue;
        ++attempts;
        try_from(points[i].arrival, order);
      }
    }
  }

  void follow_motions() {
    std::mt19937_64 engine(12345);
    const auto uniform = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -53); };
    for (int i = 0; i < density_.starts; ++i) {
      if (i % 2 == 0) {
        const double decade = -1.3 + 3.0 * i / (density_.starts - 1);
        const Traversal first = first_arrival(dynamics_, backlash_ * std::pow(10.0, decade));
        if (arrives(first)) follow(first.next);
      } else {
        const double size = backlash_ * std::pow(10.0, -1.0 + 2.0 * uniform());
        const double position = size * (2.0 * uniform() - 1.0);
        const double speed = size * (2.0 * uniform() - 1.0);
        follow({position, speed, 2.0 * size * uniform()});
      }
    }
  }

  void follow(const Arrival& start) {
    constexpr int between_looks = 16;
    std::vector<Arrival> motion = {start};
    for (int count = 1; count <= density_.traversals; ++count) {
      const std::optional<Arrival> next = next_of(dynamics_, motion.back());
      if (!next || next->norm() < 1e-9 * backlash_) return;
      motion.push_back(*next);
      if (count % between_looks == 0 && distance_to_known(*next, true) < 1e-5) return;
    }
    const Arrival& end = motion.back();
    for (int order = 1; order <= longest_of_motion; ++order) {
      const Arrival& before = motion[motion.size() - 1 - static_cast<std::size_t>(order)];
      if ((end - before).norm() > 0.02 * end.norm()) continue;
      const std::size_t known = cycles_.size();
      try_from(end, order);
      if (cycles_.size() > known) return;
    }
  }

  double backlash_;
  ServoDynamics dynamics_;
  Density density_;
  std::vector<DenseCycle> cycles_;
};

}  // namespace

double DenseCycle::distance_to(const Arrival& arrival) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Arrival& own : visited) {
    nearest = std::min(nearest, (arrival - own).norm() / own.norm());
  }
  return nearest;
}

std::vector<DenseCycle> dense_cycles(const NormalizedServo& servo, const Density& density) {
  return Finder(servo, density).run();
}

}  // namespace gearlash::benchmarks
