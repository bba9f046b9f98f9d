// Piecewise-affine hybrid systems: what they are made of. Nothing here knows of gears.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/fault.hpp"
#include "gearlash/hybrid.hpp"
#include "hybrid/mode_source.hpp"

namespace gearlash::hybrid {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// max |vᵢ|; 0 for an empty vector.
double largest_entry(const Vector& vector);

/// x′ = matrix x + offset.
struct AffineFlow {
  Matrix matrix{};
  Vector offset{};

  Vector velocity(const Vector& state) const { return matrix * state + offset; }
};

/// g(x) = normal·x + offset.
struct AffineForm {
  Vector normal{};
  double offset = 0.0;

  double at(const Eigen::Ref<const Vector>& state) const { return normal.dot(state) + offset; }
  /// The sum of its terms' sizes.
  double size_at(const Vector& state) const {
    return normal.cwiseAbs().dot(state.cwiseAbs()) + std::abs(offset);
  }
};

/// What an instrument reads: step · round(measured/step), halves away from 0.
struct Quantizer {
  AffineForm measured{};
  double step = 0.0;  ///< > 0
  Vector gain{};      ///< what the reading adds to each number of the state

  double reading(const Vector& state) const;
};

/// x⁺ = matrix x + offset + Σ gain · reading(x). An empty matrix stands for the identity, an empty
/// offset for 0.
struct AffineReset {
  Matrix matrix{};
  Vector offset{};
  std::vector<Quantizer> quantizers{};

  Vector after(const Vector& state) const;
  /// ∂x⁺/∂x, of `size` numbers; a quantizer's reading counts as constant.
  Matrix slope(Eigen::Index size) const;
};

/// The target if all of the forms are positive after the reset.
struct Alternative {
  std::vector<AffineForm> positive{};
  std::size_t target = 0;
};

/// The end of a sequence of firings of one transition that come ever faster (Zeno of Elea:
/// infinitely many in a finite time, as when a ball bounces to rest).
struct Settling {
  std::size_t target = 0;                   ///< mode
  AffineReset reset{};                      ///< onto the limit, from a state just after a firing
  std::vector<Alternative> alternatives{};  ///< as of a transition
};

/// Fires as the guard leaves its side (Direction), and then at once
///   x ← reset(x), mode ← that of the first alternative whose forms are all positive, else target.
struct Transition {
  std::string name{};
  AffineForm guard{};
  Direction direction = Direction::falling;
  AffineReset reset{};
  std::size_t target = 0;  ///< index of a mode
  std::optional<Settling> settling{};
  std::vector<Alternative> alternatives{};
};

/// Fires at the ticks of a clock.
struct TimedTransition {
  std::string name{};
  std::size_t clock = 0;  ///< index of a clock
  AffineReset reset{};
  std::size_t target = 0;
  std::vector<Alternative> alternatives{};  ///< as of a transition
};

struct AffineMode {
  std::string name{};
  AffineFlow flow{};
  std::vector<Transition> transitions{};
  std::vector<TimedTransition> timed{};
};

/// Calls visit(jump) for all that leaves a mode: transitions, their settlings and timed
/// transitions, each with a reset, a target and alternatives.
template <class Mode, class Visit>
void for_each_jump(Mode& mode, const Visit& visit) {
  for (auto& transition : mode.transitions) {
    visit(transition);
    if (transition.settling) visit(*transition.settling);
  }
  for (auto& timed : mode.timed) visit(timed);
}

/// Ticks at first, first + period, first + 2 period, …, or at each `every`-th of these times; or,
/// without a period, at `times`. A motion
/// meets those that are not before its own start.
struct Clock {
  std::string name{};
  double first = 0.0;               ///< used with a period
  double period = 0.0;              ///< > 0, or 0 if `times` are given
  std::vector<double> times{};      ///< without a period: rising
  std::vector<Vector> additions{};  ///< one for each of `times`, or none: a timed transition adds
                                    ///< it after its reset
  std::size_t every = 1;            ///< ≥ 1, used with a period
};

/// Modes with affine flows of a state x of fixed size, and the transitions between them.
///
/// In a mode x follows the mode's flow. A transition fires at the first time after which its guard
/// is on the wrong side. If the guard is 0 at the start, the first of its time derivatives that is
/// not 0 gives its side, so the motion itself arms it again. If all are 0 (the guard is 0 on an
/// interval), it does not fire. A guard that is on the wrong side as its mode begins fires at once.
/// Of several transitions at one instant, the timed ones come first, in the order of the clocks,
/// each clock once; then the others in their order in the mode. The new mode's own rules follow
/// each. So an event is never lost and never fires twice for one reason.
///
/// Modes are a list, or a source makes them when a motion first enters them.
struct HybridSystem {
  std::vector<std::string> state_names{};
  std::vector<AffineMode> modes{};  ///< empty if there is a source
  std::vector<Clock> clocks{};
  ModeSource source{};
  /// With a source: which numbers follow their own flow alone, the same in every mode, and are
  /// changed by no event (references); or are moved by no flow, and events change them by constants
  /// (counts). Empty means none. For a list of modes they are found.
  std::vector<bool> exogenous{};

  Eigen::Index size() const { return static_cast<Eigen::Index>(state_names.size()); }
  std::size_t mode_count() const { return source ? source.count() : modes.size(); }
  /// Precondition: index < mode_count().
  const AffineMode& mode(std::size_t index) const {
    return source ? source.mode(index) : modes[index];
  }
};

/// Every fault, with its place: shapes that do not agree, indices out of range, numbers that are
/// not finite, clocks that go backwards. Modes of a source are not made for this: a motion checks
/// them when it first enters them.
std::vector<Fault> faults(const HybridSystem& system);
/// The faults of one mode. Precondition: index < system.mode_count().
std::vector<Fault> faults_of_mode(const HybridSystem& system, std::size_t index);

}  // namespace gearlash::hybrid
