// The linear parts of a drive, whatever its contact does: its gap is an input. Of doubles, or of
// intervals that contain the drive's numbers.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/interval.hpp"
#include "base/lists.hpp"
#include "model/drive.hpp"
#include "model/enclosed_drive.hpp"
#include "model/held_torques.hpp"
#include "numeric/elimination.hpp"
#include "numeric/vector_algebra.hpp"

namespace gearlash {

/// What acts on the linear drive. Torques are N m at the load's shaft.
enum class LinearInput : std::size_t {
  torque,            ///< requested by the controller
  gap,               ///< u, rad: the motor less the load
  gap_speed,         ///< u̇, rad/s
  torque_on_motor,   ///< a disturbance
  torque_on_load,    ///< a disturbance
  position_reading,  ///< rad, error of the position that the controller receives
  speed_reading,     ///< rad, error of the position whose differences are the speed
  reference          ///< rad, which the position follows: positions are deviations from it
};
inline constexpr std::size_t linear_inputs = 8;

/// A number as a linear form of states and of what acts at the same moment.
template <class Number>
struct LinearForm {
  std::vector<Number> of_state{};
  std::array<Number, linear_inputs> of_inputs{};

  Number& operator[](LinearInput input) { return of_inputs[static_cast<std::size_t>(input)]; }
  const Number& operator[](LinearInput input) const {
    return of_inputs[static_cast<std::size_t>(input)];
  }
};

/// The state's own value among `size` of them.
template <class Number>
LinearForm<Number> state_form(std::size_t size, std::size_t state) {
  LinearForm<Number> form{std::vector<Number>(size, Number(0.0)), {}};
  form.of_state[state] = Number(1.0);
  return form;
}

template <class Number>
LinearForm<Number> operator+(LinearForm<Number> a, const LinearForm<Number>& b) {
  a.of_state = added(std::move(a.of_state), b.of_state);
  for (std::size_t i = 0; i < linear_inputs; ++i) a.of_inputs[i] = a.of_inputs[i] + b.of_inputs[i];
  return a;
}

template <class Number>
LinearForm<Number> operator*(const Number& factor, LinearForm<Number> form) {
  form.of_state = scaled(factor, std::move(form.of_state));
  for (Number& number : form.of_inputs) number = factor * number;
  return form;
}

/// x′ = slopes, by deviations from the motion with the gap closed.
///
/// Rigid faces: u is the gap, within ±b/2. Both shafts' equations are added, so that the mesh
/// torque cancels; with J = J_M + J_L, κ = J_M/J and z = θ_L + κ u,
///   J z̈ = τ − F ż + (Fκ − F_M) u̇ − k_g (z − κ u) + w,   T τ′ = τ_requested − E ω_M − τ
/// (the latter with inductance). The states are z, ż and τ less what u̇ feeds into each: no u̇ is
/// left in the slopes.
///
/// Compliant faces without damping: u is the gap's part within ±b/2, and both shafts are joined by
/// the spring. Without a gap the spring may be damped.
template <class Number>
struct LinearSystem {
  std::vector<LinearForm<Number>> slopes{};
  LinearForm<Number> load{};      ///< position
  LinearForm<Number> motor{};     ///< position
  LinearForm<Number> position{};  ///< sensed
  LinearForm<Number> counted{};   ///< position whose differences are the speed of a computer
  LinearForm<Number> speed{};     ///< sensed
  LinearForm<Number> effort{};    ///< torque that the controller requests
  /// ω_M′ − ω_L′ while the faces are apart; rigid faces only.
  std::optional<LinearForm<Number>> gap_acceleration{};
  // States at a start, per unit: of the position of all that moves, of its speed, and of u.
  std::vector<Number> start_of_position{};
  std::vector<Number> start_of_speed{};
  std::vector<Number> start_of_gap{};

  std::size_t size() const { return slopes.size(); }
  /// What an input adds to the slopes.
  std::vector<Number> column(LinearInput input) const;
};

/// The slopes by the states.
template <class Number>
MatrixOf<Number> flow_of(const LinearSystem<Number>& system) {
  const auto of_state = [](const LinearForm<Number>& slope) { return slope.of_state; };
  return matrix_of(of_each(system.slopes, of_state), system.size());
}

/// The numbers of shafts, winding, faces, sensors and controller, at the load's shaft.
template <class Number>
struct LinearDrive {
  Number motor_inertia{0.0};
  Number load_inertia{0.0};
  Number motor_friction{0.0};  ///< viscous
  Number load_friction{0.0};
  Number weight{0.0};  ///< k_g
  Number back_emf{0.0};
  Number electrical_time{0.0};
  bool lags = false;  ///< whether the winding delays the torque
  std::optional<drive::CompliantContactOf<Number>> spring{};  ///< of compliant faces
  Number position_share{0.0};  ///< of the load in the sensed position
  Number speed_share{0.0};
  /// As it runs, by (r, y, v) where r is the reference and an equal position together: 0 where the
  /// controller knows them by their difference alone.
  drive::LinearControllerOf<Number> controller{};
  // Of a sampled controller.
  Number period{0.0};
  std::vector<HeldTorqueOf<Number>> holds{};  ///< none: continuous
  int position_ticks = 1;                     ///< periods between two readings of the position
  bool counts = false;                        ///< the speed is a difference of positions

  std::size_t order() const { return controller.order(); }
  /// Whether the controller's torque depends on the sensed speed.
  bool uses_speed() const;
  /// Whether the controller knows reference and position by their difference alone.
  bool knows_error_alone() const;

  /// The mechanics and the winding, under the input `torque`.
  LinearSystem<Number> plant() const;
  /// The same with a continuous controller, whose states come last. The input is still `torque`,
  /// the effort is what the controller requests.
  LinearSystem<Number> open() const;
  /// With the controller in place of that input.
  LinearSystem<Number> loop() const;
  /// What the controller works out by its states, which begin at `first` among those of the forms,
  /// and its inputs.
  LinearForm<Number> worked_out(const std::vector<Number>& of_state,
                                const std::vector<Number>& of_inputs,
                                const LinearForm<Number>& position, const LinearForm<Number>& speed,
                                std::size_t first) const;
};

/// Precondition: a linear controller. For what the gap adds: rigid faces, or compliant ones without
/// damping or without a gap; all else holds for any faces that stay together.
LinearDrive<double> linear_drive(const drive::ReducedDrive& drive);
LinearDrive<Interval> linear_drive(const EnclosedDrive& drive);

}  // namespace gearlash
