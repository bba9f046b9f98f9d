// The mode of a drive: the state of its contact, frictions and torque limit.
#pragma once

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
enum class FrictionState { viscous, forward, backward, sticking };
enum class TorqueState { linear, highest, lowest };

struct DriveMode {
  ContactState contact = ContactState::apart;
  FrictionState motor = FrictionState::viscous;
  FrictionState load = FrictionState::viscous;
  TorqueState torque = TorqueState::linear;

  bool operator==(const DriveMode&) const = default;
};

/// The contact's state with the gap closed: joined, or on the forward face.
ContactState closed_contact(const ReducedDrive& drive);

/// +1 on the forward face, −1 on the backward one, 0 apart or joined.
double face_of(ContactState contact);

/// Direction of a shaft's motion; 0 if it sticks, or if friction does not depend on it.
double way_of(FrictionState friction);

/// As reports name it.
std::string text_of(const DriveMode& mode);

/// The modes of a drive, numbered without a list. A number encodes the contact's state, the pair of
/// frictions and the torque's state in turn. Engaged rigid faces permit only frictions of shafts
/// that move as one.
class DriveModes {
 public:
  DriveModes() = default;
  explicit DriveModes(const ReducedDrive& drive);

  std::size_t count() const;
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
  std::vector<TorqueState> torques_;
};

}  // namespace gearlash::drive
