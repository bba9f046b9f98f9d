#include "general/assemble/drive_mode.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gearlash::drive {
namespace {

const char* text_of(ContactState contact) {
  constexpr std::array<const char*, 8> names = {"apart",
                                                "forward",
                                                "backward",
                                                "forward, damping limited",
                                                "backward, damping limited",
                                                "forward, letting go",
                                                "backward, letting go",
                                                "joined"};
  return names[static_cast<std::size_t>(contact)];
}

const char* text_of(FrictionState friction) {
  constexpr std::array<const char*, 4> names = {"", "moves forward", "moves backward", "sticks"};
  return names[static_cast<std::size_t>(friction)];
}

std::vector<ContactState> contacts_of(const ReducedDrive& drive) {
  using enum ContactState;
  if (is_joined(drive)) return {joined};
  const Contact& contact = drive.contact;
  std::vector<ContactState> all = {apart, forward, backward};
  const auto* compliant = std::get_if<CompliantContact>(&contact);
  if (compliant == nullptr || !(compliant->damping > 0.0)) return all;
  all.insert(all.end(), {forward_letting_go, backward_letting_go});
  if (compliant->law == ContactDamping::limited) {
    all.insert(all.end(), {forward_limited, backward_limited});
  }
  return all;
}

std::vector<FrictionState> frictions_of(const Shaft& shaft) {
  using enum FrictionState;
  if (!shaft.friction.is_dry()) return {viscous};
  return {forward, backward, sticking};
}

template <class State>
std::size_t place_in(const std::vector<State>& all, const State& state) {
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), state) - all.begin());
}

}  // namespace

ContactState closed_contact(const ReducedDrive& drive) {
  return is_joined(drive) ? ContactState::joined : ContactState::forward;
}

double face_of(ContactState contact) {
  switch (contact) {
    case ContactState::forward:
    case ContactState::forward_limited:
    case ContactState::forward_letting_go:
      return 1.0;
    case ContactState::backward:
    case ContactState::backward_limited:
    case ContactState::backward_letting_go:
      return -1.0;
    case ContactState::apart:
    case ContactState::joined:
      break;
  }
  return 0.0;
}

double way_of(FrictionState friction) {
  if (friction == FrictionState::forward) return 1.0;
  return friction == FrictionState::backward ? -1.0 : 0.0;
}

std::string text_of(const DriveMode& mode) {
  std::string text = text_of(mode.contact);
  if (mode.motor != FrictionState::viscous) text += std::string("; motor ") + text_of(mode.motor);
  if (mode.load != FrictionState::viscous) text += std::string("; load ") + text_of(mode.load);
  if (mode.torque == TorqueState::highest) text += "; torque at its highest";
  if (mode.torque == TorqueState::lowest) text += "; torque at its lowest";
  return text;
}

DriveModes::DriveModes(const ReducedDrive& drive)
    : is_rigid_(std::holds_alternative<RigidContact>(drive.contact)),
      contacts_(contacts_of(drive)),
      torques_{TorqueState::linear} {
  for (const FrictionState motor : frictions_of(drive.motor)) {
    for (const FrictionState load : frictions_of(drive.load)) {
      const bool as_one =
          motor == load || motor == FrictionState::viscous || load == FrictionState::viscous;
      apart_.emplace_back(motor, load);
      if (as_one) together_.emplace_back(motor, load);
    }
  }
  if (std::isfinite(drive.torque_limit)) {
    torques_.insert(torques_.end(), {TorqueState::highest, TorqueState::lowest});
  }
}

const std::vector<DriveModes::Frictions>& DriveModes::frictions_in(ContactState contact) const {
  return is_rigid_ && contact != ContactState::apart ? together_ : apart_;
}

std::size_t DriveModes::count() const {
  std::size_t count = 0;
  for (const ContactState contact : contacts_) {
    count += frictions_in(contact).size() * torques_.size();
  }
  return count;
}

std::size_t DriveModes::index_of(const DriveMode& mode) const {
  std::size_t first = 0;  // index of the first mode with this contact
  for (const ContactState contact : contacts_) {
    const std::vector<Frictions>& frictions = frictions_in(contact);
    if (contact == mode.contact) {
      const std::size_t pair = place_in(frictions, {mode.motor, mode.load});
      const std::size_t torque = place_in(torques_, mode.torque);
      if (pair == frictions.size() || torque == torques_.size()) break;
      return first + pair * torques_.size() + torque;
    }
    first += frictions.size() * torques_.size();
  }
  return count();
}

DriveMode DriveModes::mode(std::size_t index) const {
  for (const ContactState contact : contacts_) {
    const std::vector<Frictions>& frictions = frictions_in(contact);
    const std::size_t here = frictions.size() * torques_.size();
    if (index < here) {
      const auto& [motor, load] = frictions[index / torques_.size()];
      return {contact, motor, load, torques_[index % torques_.size()]};
    }
    index -= here;
  }
  return {};
}

}  // namespace gearlash::drive
