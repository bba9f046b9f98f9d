#include "hybrid/passage.hpp"

#include <cmath>

#include "hybrid/disturbances.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {

Vector flown(const AffineFlow& flow, const Vector& numbers, double time) {
  const Eigen::Index size = numbers.size();
  Matrix augmented = Matrix::Zero(size + 1, size + 1);
  augmented.topLeftCorner(size, size) = flow.matrix;
  augmented.topRightCorner(size, 1) = flow.velocity(numbers);
  return numbers + Vector(exponential(augmented * time).topRightCorner(size, 1));
}

namespace {

/// How much later than a time, or earlier, the flow of a mode crosses a plane. Empty if it does
/// not. `at` gives the numbers so much later.
template <class At>
std::optional<double> time_to_plane(const AffineMode& mode, const At& at, double time,
                                    const AffineForm& plane) {
  double later = 0.0;
  for (int i = 0; i < 40; ++i) {
    const Vector here = at(later);
    const double step = -plane.at(here) / plane.normal.dot(mode.flow.velocity(here));
    if (!std::isfinite(step)) return std::nullopt;
    later += step;
    constexpr double short_step = 1e-15;
    if (std::abs(step) <= short_step * (time + later)) break;
  }
  return later;
}

/// Events of a motion, and its state after them.
struct Arrival {
  std::vector<Event> events;
  State end;
  double time;
};

/// A motion over a number of events and until a time. If another event comes before, it ends there;
/// if the last one comes later, at that one, which may be this late.
Trajectory motion_over(const PreparedSystem& prepared, const State& start, double from,
                       std::size_t events, double until, double latest) {
  Trajectory motion = simulate(prepared, start,
                               {.from = from,
                                .until = until,
                                .event_limit = events + 1,
                                .step_limit = most_steps_of_a_shot});
  if (motion.events().size() >= events) return motion;
  return simulate(
      prepared, start,
      {.from = from, .until = latest, .event_limit = events, .step_limit = most_steps_of_a_shot});
}

/// Where a motion crosses a plane after its last event, near a time. The crossing is sought from a
/// state nearby, because an exponential over a long time loses digits.
std::optional<Arrival> arrival_at(const PreparedSystem& prepared, const State& start, double from,
                                  std::size_t events, const AffineForm& plane, double near) {
  // A plane that the flow hardly approaches may be crossed after ages.
  constexpr double patience = 4.0;
  const double latest = from + patience * (near - from);
  const Trajectory motion = motion_over(prepared, start, from, events, near, latest);
  std::vector<Event> passed = motion.events();
  if (passed.size() < events) return std::nullopt;
  State here = motion.end();
  if (passed.size() > events) {
    here = {passed.back().mode, passed.back().before};
    passed.pop_back();
  }
  const AffineMode& mode = prepared.system().mode(here.mode);
  const double last = passed.empty() ? from : passed.back().time;
  // Backwards the motion is known. The flow's exponential would raise the rounding of fast decays.
  const auto at = [&](double later) {
    const double time = motion.end_time() + later;
    return later < 0.0 && time > last ? motion.at(time).numbers
                                      : flown(mode.flow, here.numbers, later);
  };
  const auto later = time_to_plane(mode, at, motion.end_time(), plane);
  if (!later) return std::nullopt;
  const double time = motion.end_time() + *later;
  if (!(time >= last) || time > latest) return std::nullopt;
  if (*later > 0.0 &&
      motion_over(prepared, start, from, events, time, time).events().size() > events)
    return std::nullopt;
  here.numbers = at(*later);
  return Arrival{std::move(passed), std::move(here), time};
}

std::optional<Arrival> arrival_after(const PreparedSystem& prepared, const State& start,
                                     double from, std::size_t events, double time) {
  const Trajectory motion = simulate(
      prepared, start,
      {.from = from, .until = time, .event_limit = events + 1, .step_limit = most_steps_of_a_shot});
  const bool arrives = motion.stop_reason() == StopReason::reached_end;
  if (!arrives || motion.events().size() != events) return std::nullopt;
  return Arrival{motion.events(), motion.end(), time};
}

}  // namespace

std::optional<Passage> pass(const PreparedSystem& prepared, const State& start, double from,
                            std::size_t events, const Finish& finish) {
  const HybridSystem& system = prepared.system();
  auto arrival = finish.plane
                     ? arrival_at(prepared, start, from, events, *finish.plane, finish.time)
                     : arrival_after(prepared, start, from, events, finish.time);
  if (!arrival) return std::nullopt;
  Disturbances disturbances(system, start, from);
  for (const Event& event : arrival->events) {
    if (!disturbances.meet(event)) return std::nullopt;
  }
  disturbances.flow_to(arrival->time);
  Passage passage;
  passage.events = std::move(arrival->events);
  passage.end = std::move(arrival->end);
  passage.duration = arrival->time - from;
  passage.slope_at_time = disturbances.slope();
  passage.slope = passage.slope_at_time;
  passage.duration_slope = Vector::Zero(system.size());
  if (!finish.plane) return passage;
  const Vector flow = system.mode(passage.end.mode).flow.velocity(passage.end.numbers);
  passage.duration_slope = -(finish.plane->normal.transpose() * passage.slope).transpose() /
                           finish.plane->normal.dot(flow);
  passage.slope += flow * passage.duration_slope.transpose();
  return passage;
}

}  // namespace gearlash::hybrid
