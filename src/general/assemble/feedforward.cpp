// What a controller adds because of its reference's motion.
#include <algorithm>
#include <cmath>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {
namespace {

/// The largest speed of the reference's generator, at its settings and its start.
double fastest_reference(const DriveForms& forms) {
  const Generator& generator = forms.reference_generator();
  const hybrid::Vector speed = generator.flow.transpose() * generator.output;
  double fastest = speed.cwiseAbs().dot(generator.start.cwiseAbs());
  for (const hybrid::Vector& setting : generator.settings) {
    fastest = std::max(fastest, speed.cwiseAbs().dot(setting.cwiseAbs()));
  }
  return fastest;
}

/// A reference that comes to rest has a rest of speed by rounding, which is no motion.
double least_speed(const DriveForms& forms) {
  constexpr double rounding = 1e-9;
  return rounding * fastest_reference(forms);
}

/// The speed at which the feedforward of friction is complete.
double whole_speed(const DriveForms& forms) {
  return std::max(forms.drive().feedforward.speed, least_speed(forms));
}

void add_speed(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  if (forms.drive().feedforward.torque == 0.0) return;
  const hybrid::AffineForm speed = forms.reference_speed();
  const double whole = whole_speed(forms);
  add_branches(forms, mode, &DriveMode::reference_speed, {speed, whole}, {speed, whole},
               {"reference moves forward", "reference moves backward", "reference slows down"},
               built);
}

/// The last motion, which is remembered.
void add_way(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  if (forms.drive().feedforward.half_gap == 0.0) return;
  const hybrid::AffineForm speed = forms.reference_speed();
  for (const Branch branch : {Branch::forward, Branch::backward}) {
    if (branch == mode.reference_way) continue;
    const double way = sign_of(branch);
    const DriveMode target = with(mode, &DriveMode::reference_way, branch);
    built.transitions.push_back(transition(
        way > 0.0 ? "reference turns forward" : "reference turns backward",
        speed - way * least_speed(forms), rising_on(way), forms.modes().index_of(target)));
  }
}

}  // namespace

void add_feedforward(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  add_speed(forms, mode, built);
  add_way(forms, mode, built);
}

DriveMode first_feedforward(const DriveForms& forms, const hybrid::Vector& start) {
  const Feedforward& forward = forms.drive().feedforward;
  const double speed = forms.reference_speed().at(start);
  const auto beyond = [&](double least) {
    return branch_of(std::abs(speed) <= least ? 0.0 : speed);
  };
  DriveMode mode;
  if (forward.torque != 0.0) mode.reference_speed = beyond(whole_speed(forms));
  if (forward.half_gap != 0.0) mode.reference_way = beyond(least_speed(forms));
  return mode;
}

std::vector<hybrid::Alternative> reference_speeds(const DriveForms& forms, const DriveMode& mode) {
  std::vector<hybrid::Alternative> alternatives;
  for (const Branch branch : {Branch::forward, Branch::backward}) {
    alternatives.push_back(
        {{sign_of(branch) * forms.reference_speed() - whole_speed(forms)},
         forms.modes().index_of(with(mode, &DriveMode::reference_speed, branch))});
  }
  return alternatives;
}

}  // namespace gearlash::drive
