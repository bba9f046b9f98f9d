#include "hybrid/hybrid_trajectory.hpp"

#include <algorithm>
#include <utility>

#include "hybrid/preparation.hpp"

namespace gearlash::hybrid {

const std::string& Event::name(const HybridSystem& system) const {
  const AffineMode& of = system.mode(mode);
  return kind == EventKind::timed ? of.timed[transition].name : of.transitions[transition].name;
}

const HybridSystem& PreparedSystem::system() const { return preparation_->system(); }

const std::vector<bool>& PreparedSystem::exogenous() const { return preparation_->exogenous(); }

void Trajectory::begin(std::shared_ptr<const Preparation> preparation, double time) {
  preparation_ = std::move(preparation);
  constexpr std::size_t some = 8;
  events_.reserve(some);
  steps_.reserve(2 * some);
  starts_.reserve(2 * some * static_cast<std::size_t>(preparation_->system().size()));
  start_time_ = time;
  end_time_ = time;
}

Eigen::Map<const Vector> Trajectory::step_start(std::size_t step) const {
  const Eigen::Index size = end_.numbers.size();
  return {&starts_[step * static_cast<std::size_t>(size)], size};
}

State Trajectory::at(double time) const {
  State state;
  at(time, state);
  return state;
}

void Trajectory::at(double time, State& state) const {
  if (steps_.empty() || time >= end_time_) {
    state = end_;
    return;
  }
  const auto after =
      std::upper_bound(steps_.begin(), steps_.end(), time,
                       [](double wanted, const Step& step) { return wanted < step.time; });
  const auto step = after == steps_.begin() ? after : after - 1;
  const auto start = step_start(static_cast<std::size_t>(step - steps_.begin()));
  state.mode = step->mode;
  state.numbers = start;
  const PreparedMode& mode = preparation_->mode(step->mode);
  const PreparedMode::Slow* slow = step->slow > 0 ? &mode.slow()[step->slow - 1] : nullptr;
  const LinearFlow& flow = slow != nullptr ? slow->flow.flow : mode.whole.flow;
  thread_local Velocity velocity;
  thread_local std::vector<double> scratch;
  flow.velocity_at(start.data(), velocity);
  flow.advance(velocity, std::max(0.0, time - step->time), state.numbers.data(), scratch);
  if (slow != nullptr) slow->decays.put_at_rest(state.numbers);
}

const std::vector<AffineForm>& MotionObserver::watched() const {
  static const std::vector<AffineForm> none;
  return none;
}

}  // namespace gearlash::hybrid
