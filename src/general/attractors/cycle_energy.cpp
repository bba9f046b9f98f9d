#include "general/attractors/cycle_energy.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <map>
#include <utility>

#include "general/assemble/drive_forms.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::Trajectory;

/// The product of a torque and a speed, and where it is booked.
struct Power {
  double EnergyBalance::*account;
  AffineForm torque;
  AffineForm speed;
};

/// The powers of each mode, in the frame.
class Powers {
 public:
  explicit Powers(const SearchSetting& setting) : forms_(setting.drive), frame_(setting.frame) {}

  const std::vector<Power>& in(std::size_t mode) {
    const auto [place, is_new] = kept_.try_emplace(mode);
    if (is_new) place->second = made(forms_.modes().mode(mode));
    return place->second;
  }

  /// J, at two states of which the second follows from the first at once.
  double kinetic_loss(const hybrid::Event& event) const {
    double loss = 0.0;
    for (const Side side : {Side::motor, Side::load}) {
      const double scale = frame_.scale[speed_of(side)];
      const double before = scale * event.before[speed_of(side)];
      const double after = scale * event.after[speed_of(side)];
      loss += 0.5 * forms_.shaft(side).inertia * (before - after) * (before + after);
    }
    return loss;
  }

 private:
  std::vector<Power> made(const DriveMode& mode) const {
    std::vector<Power> powers;
    const auto add = [&](double EnergyBalance::*account, AffineForm torque, AffineForm speed) {
      if (torque.normal.isZero(0.0) && torque.offset == 0.0) return;
      powers.push_back(
          {account, frame_.inside(std::move(torque)), frame_.inside(std::move(speed))});
    };
    const auto add_friction = [&](Side side, double EnergyBalance::*viscous,
                                  double EnergyBalance::*dry) {
      const AffineForm speed = forms_.number(speed_of(side));
      const AffineForm linear = forms_.shaft(side).friction.viscous * speed;
      add(viscous, linear, speed);
      add(dry, forms_.friction_torque(side, mode.*friction_of(side)) - linear, speed);
    };
    add(&EnergyBalance::motor, forms_.motor_torque(mode), forms_.number(motor_speed));
    add(&EnergyBalance::load_torque, forms_.load_torque(), forms_.number(load_speed));
    add_friction(Side::motor, &EnergyBalance::motor_friction, &EnergyBalance::motor_dry_friction);
    add_friction(Side::load, &EnergyBalance::load_friction, &EnergyBalance::load_dry_friction);
    if (!forms_.is_rigid() && mode.contact != ContactState::apart) {
      add(&EnergyBalance::contact_damping,
          forms_.mesh_torque(mode) - forms_.spring_torque(face_of(mode.contact)),
          forms_.gap_speed());
    }
    return powers;
  }

  DriveForms forms_;
  MovingFrame frame_;
  std::map<std::size_t, std::vector<Power>> kept_;
};

}  // namespace

EnergyBalance energy_of(const SearchSetting& setting, const Trajectory& motion) {
  // Numbers grow by e² at most in a step (longest_in_rates), their products by e⁴. Ten points leave
  // out less than 1e-18 of that: 4²⁰ (10!)⁴/(21 (20!)³).
  using Points = boost::math::quadrature::gauss<double, 10>;
  Powers powers(setting);
  EnergyBalance energy;
  hybrid::State state;
  for (std::size_t step = 0; step < motion.steps(); ++step) {
    const double from = motion.step_time(step);
    const double to = step + 1 < motion.steps() ? motion.step_time(step + 1) : motion.end_time();
    if (!(to > from)) continue;
    const double half = 0.5 * (to - from);
    for (std::size_t point = 0; point < Points::abscissa().size(); ++point) {
      for (const double side : {-1.0, 1.0}) {
        motion.at(from + half * (1.0 + side * Points::abscissa()[point]), state);
        for (const auto& [account, torque, speed] : powers.in(state.mode)) {
          energy.*account +=
              half * Points::weights()[point] * torque.at(state.numbers) * speed.at(state.numbers);
        }
      }
    }
  }
  for (const hybrid::Event& event : motion.events()) energy.impacts += powers.kinetic_loss(event);
  return energy;
}

}  // namespace gearlash::drive
