#include "hybrid/shrinking_rounds.hpp"

#include <cmath>
#include <vector>

#include "base/lists.hpp"
#include "hybrid/linear_flow.hpp"

namespace gearlash::hybrid {
namespace {

/// How many of the last events are each of the kind of that `round` events before.
std::size_t length_of_tail(const std::vector<Event>& events, std::size_t round) {
  std::size_t length = 0;
  while (length + round < events.size()) {
    const Event& one = events[events.size() - 1 - length];
    if (!one.is_alike(events[events.size() - 1 - length - round])) break;
    ++length;
  }
  return length;
}

/// Rounds at the end of a motion.
struct Rounds {
  std::size_t events = 0;  ///< of each
  std::size_t half = 0;    ///< events of as many rounds as there are twice
};

std::optional<Rounds> last_rounds(const std::vector<Event>& events) {
  constexpr std::size_t longest = 32;
  constexpr std::size_t least_in_half = 4;
  for (std::size_t round = 1; round <= longest; ++round) {
    const std::size_t tail = length_of_tail(events, round);
    const std::size_t in_half = tail / (2 * round);
    if (in_half >= least_in_half) return Rounds{round, in_half * round};
  }
  return std::nullopt;
}

/// Numbers, and by how much each of them may be off.
class Nearness {
 public:
  Nearness(const RoundsLimit& limit, double tolerance) : limit_(limit), tolerance_(tolerance) {}

  /// Whether A x + b is 0 at the limit.
  bool is_zero(const Matrix& matrix, const Vector& offset) const {
    const Vector value = matrix * limit_.numbers + offset;
    const Vector terms = matrix.cwiseAbs() * limit_.numbers.cwiseAbs() + offset.cwiseAbs();
    const Vector change = matrix.cwiseAbs() * limit_.off;
    return (value.array().abs() <= tolerance_ * change.array() + sum_rounding * terms.array())
        .all();
  }
  bool is_zero(const AffineForm& form) const {
    return std::abs(form.at(limit_.numbers)) <= tolerance_ * change_of(form) + rounding_of(form);
  }
  /// Whether the form keeps its sign for the rest of the motion.
  bool is_clear(const AffineForm& form) const {
    return std::abs(form.at(limit_.numbers)) > change_of(form) + rounding_of(form);
  }
  bool is_zero_or_clear(const AffineForm& form) const { return is_zero(form) || is_clear(form); }

 private:
  double change_of(const AffineForm& form) const { return form.normal.cwiseAbs().dot(limit_.off); }
  double rounding_of(const AffineForm& form) const {
    return sum_rounding * form.size_at(limit_.numbers);
  }

  const RoundsLimit& limit_;
  double tolerance_;
};

/// Extrapolated from three states. Empty if they do not approach it by one ratio.
std::optional<Vector> limit_of_states(const Vector& first, const Vector& second,
                                      const Vector& third, double most, double tolerance) {
  const Vector before = second - first;
  const Vector step = third - second;
  const double ratio = step.dot(before) / before.squaredNorm();
  if (!(ratio > 0.0 && ratio <= most)) return std::nullopt;
  const Vector misfit = step - ratio * before;
  const Vector rounding = sum_rounding * (first.cwiseAbs() + second.cwiseAbs() + third.cwiseAbs());
  const bool is_by_one_ratio =
      (misfit.array().abs() <= tolerance * step.array().abs() + rounding.array()).all();
  if (!is_by_one_ratio) return std::nullopt;
  return third + ratio / (1.0 - ratio) * step;
}

/// From an event to the end of the motion.
Vector farthest_off(const Trajectory& motion, std::size_t event, const Vector& limit) {
  constexpr int samples = 8;  // between two events
  Vector off = Vector::Zero(limit.size());
  const auto include = [&](const Vector& numbers) {
    off = off.cwiseMax((numbers - limit).cwiseAbs());
  };
  const std::vector<Event>& events = motion.events();
  for (std::size_t i = event; i < events.size(); ++i) {
    include(events[i].before);
    include(events[i].after);
    const double to = i + 1 < events.size() ? events[i + 1].time : motion.end_time();
    for (int k = 1; k < samples; ++k) {
      include(motion.at(events[i].time + (to - events[i].time) * k / samples).numbers);
    }
  }
  return off;
}

/// A guard that fires is not clear, since the motion meets it: it is zero.
bool is_homogeneous(const AffineMode& mode, const Nearness& near) {
  return mode.timed.empty() && near.is_zero(mode.flow.matrix, mode.flow.offset) &&
         all_of(mode.transitions,
                [&](const Transition& one) { return near.is_zero_or_clear(one.guard); });
}

bool is_homogeneous(const Transition& fired, const Nearness& near) {
  const AffineReset& reset = fired.reset;
  if (!reset.quantizers.empty()) return false;
  const Eigen::Index size = fired.guard.normal.size();
  const Matrix change = reset.slope(size) - Matrix::Identity(size, size);
  const Vector offset = reset.offset.size() > 0 ? reset.offset : Vector::Zero(size);
  return near.is_zero(change, offset) && all_of(fired.alternatives, [&](const auto& one) {
           return all_of(one.positive,
                         [&](const AffineForm& form) { return near.is_zero_or_clear(form); });
         });
}

}  // namespace

std::optional<RoundsLimit> shrinking_rounds(const HybridSystem& system, const Trajectory& motion,
                                            double ratio, double tolerance) {
  const std::vector<Event>& events = motion.events();
  const auto rounds = last_rounds(events);
  if (!rounds) return std::nullopt;
  const std::size_t last = events.size() - 1;
  const auto limit =
      limit_of_states(events[last - 2 * rounds->half].after, events[last - rounds->half].after,
                      events[last].after, ratio, tolerance);
  if (!limit) return std::nullopt;
  const std::size_t first = last - rounds->events;  // of the last round
  RoundsLimit found{*limit, farthest_off(motion, first, *limit)};
  const Nearness near(found, tolerance);
  for (std::size_t i = first + 1; i <= last; ++i) {
    const Event& event = events[i];
    if (event.kind != EventKind::transition) return std::nullopt;
    const AffineMode& mode = system.mode(event.mode);
    if (!is_homogeneous(mode, near) || !is_homogeneous(mode.transitions[event.transition], near)) {
      return std::nullopt;
    }
  }
  return found;
}

}  // namespace gearlash::hybrid
