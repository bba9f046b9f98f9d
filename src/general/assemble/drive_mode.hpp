// The mode of a drive: the state of each of its small automata.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "model/drive.hpp"

namespace gearlash::drive {

enum class ContactState {
  apart,
  forward,
  backward,
  forward_limited,
  backward_limited,
  forward_letting_go,
  backward_letting_go,
  joined  ///< compliant faces without a gap
};
enum class FrictionState {
  viscous,
  forward,
  backward,
  sticking,
  forward_slowly,  ///< below the Stribeck speed, where the dry friction falls
  backward_slowly
};
/// The branch of an odd function of pieces: a limit, a dead band, a relay.
enum class Branch { inner, forward, backward };

struct DriveMode {
  ContactState contact = ContactState::apart;
  FrictionState motor = FrictionState::viscous;
  FrictionState load = FrictionState::viscous;
  Branch torque = Branch::inner;   ///< of its limit
  Branch current = Branch::inner;  ///< of the limit of a winding's torque
  /// Of the last torque that a sampled controller worked out, where it is not the one held.
  Branch worked_out = Branch::inner;
  Branch error = Branch::inner;            ///< of ReducedDrive::error_shape
  Branch reference_speed = Branch::inner;  ///< of the feedforward of friction
  Branch reference_way = Branch::inner;    ///< last motion of the reference; inner before the first

  bool operator==(const DriveMode&) const = default;
};

/// The mode with one of its automata in another state.
template <class State>
DriveMode with(DriveMode mode, State DriveMode::*automaton, State state) {
  mode.*automaton = state;
  return mode;
}

/// The contact's state with the gap closed: joined, or on the forward face.
ContactState closed_contact(const ReducedDrive& drive);

/// +1 on the forward face, −1 on the backward one, 0 apart or joined.
double face_of(ContactState contact);

/// Direction of a shaft's motion; 0 if it sticks, or if friction does not depend on it.
double way_of(FrictionState friction);

/// +1, −1, or 0 on the inner branch.
double sign_of(Branch branch);
/// The branch of this sign.
Branch branch_of(double sign);

/// The state of a shaft as it begins to move in a direction, or sticks (0).
FrictionState moving(const Shaft& shaft, double way);

/// The state of a shaft that moves in a direction faster than its friction falls.
FrictionState moving_fast(double way);

/// The state of a shaft that has this speed.
FrictionState friction_at(const Shaft& shaft, double speed);

/// Whether the limit of the last torque worked out is a state of its own: anti-windup, and an
/// output that has not yet taken effect as the next sample is taken.
bool remembers_worked_out(const ReducedDrive& drive);

/// As reports name it.
std::string text_of(const DriveMode& mode);

/// The modes of a drive, numbered without a list. A number encodes the contact's state, the pair of
/// frictions and the states of all others in turn. Engaged rigid faces permit only frictions of
/// shafts that move as one.
class DriveModes {
 public:
  DriveModes() = default;
  explicit DriveModes(const ReducedDrive& drive);

  std::size_t count() const;
  /// Number of combinations of the states other than contact and frictions. A mode's number modulo
  /// this names its combination.
  std::size_t others() const { return others_; }
  /// count() if a drive has no such mode.
  std::size_t index_of(const DriveMode& mode) const;
  bool has(const DriveMode& mode) const { return index_of(mode) < count(); }
  /// Precondition: index < count().
  DriveMode mode(std::size_t index) const;

 private:
  using Frictions = std::pair<FrictionState, FrictionState>;  ///< of motor and load
  const std::vector<Frictions>& frictions_in(ContactState contact) const;

  bool is_rigid_ = false;
  std::vector<ContactState> contacts_;
  std::vector<Frictions> apart_;     ///< all pairs
  std::vector<Frictions> together_;  ///< those of shafts that move as one
  /// Of torque, current, worked_out, error, reference_speed and reference_way.
  std::array<bool, 6> has_{};
  std::size_t others_ = 1;  ///< number of their combinations
};

}  // namespace gearlash::drive
