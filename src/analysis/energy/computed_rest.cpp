#include "analysis/energy/computed_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "base/special_numbers.hpp"
#include "numeric/linear_algebra.hpp"
#include "numeric/polytope.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

// ---- the controller -----------------------------------------------------------------------------

/// The readings and requested torques with which a controller stands: (reading, torque) = one +
/// any multiple of each direction.
struct StandingRequests {
  Vector2d one;
  std::vector<Vector2d> directions;  ///< none, one, or two that span all
};

/// Of z′ = A z + B (r, y) + w (τ − C z − D (r, y)), 0 at rest, or z with a clock, where τ is the
/// limit and w the anti-windup's; empty where no state stands. `limit`: ±torque limit, or none.
std::optional<StandingRequests> standing_requests(const ReducedDrive& drive, double reference,
                                                  std::optional<double> limit) {
  const LinearController controller =
      drive.sampling ? drive::sampled_controller(drive.controller, *drive.sampling)
                     : drive::linear_controller(drive.controller);
  const std::size_t order = controller.order();
  const auto size = static_cast<Eigen::Index>(order);
  const auto weight = [&](std::size_t i) {
    return limit && !controller.anti_windup.empty() ? controller.anti_windup[i] : 0.0;
  };
  Eigen::MatrixXd matrix(size, size + 1);  // of the states and the reading
  VectorXd right(size);
  for (std::size_t i = 0; i < order; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < order; ++j) {
      const double kept = drive.sampling && i == j ? 1.0 : 0.0;
      matrix(row, static_cast<Eigen::Index>(j)) =
          controller.state_matrix[i][j] - kept - weight(i) * controller.output[j];
    }
    matrix(row, size) = controller.input_matrix[i][1] - weight(i) * controller.direct[1];
    right[row] = -(controller.input_matrix[i][0] - weight(i) * controller.direct[0]) * reference -
                 weight(i) * limit.value_or(0.0);
  }
  const std::optional<Solutions> all = all_solutions(matrix, right);
  if (!all) return std::nullopt;
  const auto seen = [&](const VectorXd& solution) {
    double torque = controller.direct[1] * solution[size];
    for (std::size_t j = 0; j < order; ++j) {
      torque += controller.output[j] * solution[static_cast<Eigen::Index>(j)];
    }
    return Vector2d(solution[size], torque);
  };
  StandingRequests requests{seen(all->one), {}};
  requests.one[1] += controller.direct[0] * reference;
  constexpr double parallel = 1e-9;
  for (const auto& solution : all->directions.colwise()) {
    const Vector2d direction = seen(VectorXd(solution));
    if (direction.isZero(0.0)) continue;
    const bool is_new =
        std::all_of(requests.directions.begin(), requests.directions.end(), [&](const auto& known) {
          const double area = known[0] * direction[1] - known[1] * direction[0];
          return std::abs(area) >
                 parallel * (std::abs(known[0] * direction[1]) + std::abs(known[1] * direction[0]));
        });
    if (is_new) requests.directions.push_back(direction);
  }
  return requests;
}

// ---- the drive ----------------------------------------------------------------------------------

/// The load's position from the reference, the gap, the mesh torque, the requested torque.
enum Unknown : Eigen::Index { load, gap, mesh, torque, unknowns };

Vector4d unit(Unknown unknown) { return Vector4d::Unit(unknown); }

/// rad. Equilibria that reach this far have no end.
constexpr double endless = 1e6;

enum class Engaged { backward, none, forward };

class Equilibria {
 public:
  Equilibria(const ReducedDrive& drive, double reference, double load_torque)
      : drive_(drive), reference_(reference), load_torque_(load_torque) {}

  /// Those of all contact states, with the torque within its limit or at one.
  void find() {
    add_with(std::nullopt);
    if (!std::isfinite(drive_.torque_limit)) return;
    add_with(drive_.torque_limit);
    add_with(-drive_.torque_limit);
  }

  const Extent& of_load() const { return load_; }
  const Extent& of_motor() const { return motor_; }

 private:
  void add_with(std::optional<double> limit) {
    const auto requests = standing_requests(drive_, reference_, limit);
    if (!requests) return;
    if (drive::is_joined(drive_)) return add(standing(Engaged::none, limit), *requests);
    for (const Engaged face : {Engaged::backward, Engaged::none, Engaged::forward}) {
      add(standing(face, limit), *requests);
    }
  }

  /// The balance of both shafts, and the contact.
  Polytope standing(Engaged face, std::optional<double> limit) const {
    Polytope all(unknowns);
    const double load_friction = drive_.load.friction.breakaway;
    const double motor_friction = drive_.motor.friction.breakaway;
    const drive::Gravity& gravity = drive_.gravity;
    const double pulled = load_torque_ - gravity.stiffness * (reference_ - gravity.angle);
    all.between(unit(mesh) - gravity.stiffness * unit(load), -pulled - load_friction,
                -pulled + load_friction);
    if (limit) {
      all.between(unit(mesh), *limit - motor_friction, *limit + motor_friction);
      if (*limit > 0.0) all.between(unit(torque), *limit, infinity);
      if (*limit < 0.0) all.between(unit(torque), -infinity, *limit);
    } else {
      all.between(unit(torque) - unit(mesh), -motor_friction, motor_friction);
      all.between(unit(torque), -drive_.torque_limit, drive_.torque_limit);
    }
    touch(face, all);
    all.between(unit(load), -endless, endless);
    return all;
  }

  void touch(Engaged face, Polytope& all) const {
    const auto* compliant = std::get_if<drive::CompliantContact>(&drive_.contact);
    const double half = 0.5 * drive_.backlash;
    if (face == Engaged::none && !drive::is_joined(drive_)) {
      all.equal(unit(mesh), 0.0).between(unit(gap), -half, half);
      return;
    }
    const double side = face == Engaged::none ? 0.0 : face == Engaged::forward ? 1.0 : -1.0;
    if (compliant != nullptr) {
      all.equal(unit(mesh) - compliant->stiffness * unit(gap), -compliant->stiffness * side * half);
    } else {
      all.equal(unit(gap), side * half);
    }
    if (side != 0.0) all.between(side * unit(mesh), 0.0, infinity);
  }

  /// The sensed position, less the reference.
  Vector4d sensed() const {
    return unit(load) + (1.0 - drive_.sensing.load_share_of_position) * unit(gap);
  }

  void add(const Polytope& standing, const StandingRequests& requests) {
    if (requests.directions.size() == 2) return include(standing);
    const double step = drive_.sensing.resolution;
    if (step > 0.0) return add_read(standing, requests, step);
    Polytope all = standing;
    const Vector2d& one = requests.one;
    if (requests.directions.empty()) {
      all.equal(sensed(), one[0] - reference_).equal(unit(torque), one[1]);
    } else {
      const Vector2d& way = requests.directions.front();
      all.equal(way[1] * sensed() - way[0] * unit(torque),
                way[1] * (one[0] - reference_) - way[0] * one[1]);
    }
    include(all);
  }

  /// With an encoder: each of its readings has its own torque, and its own positions.
  void add_read(const Polytope& standing, const StandingRequests& requests, double step) {
    const Vector2d& one = requests.one;
    const auto in_step = [&](Polytope all, double reading) {
      return all.between(sensed(), reading - 0.5 * step - reference_,
                         reading + 0.5 * step - reference_);
    };
    const Vector2d way =
        requests.directions.empty() ? Vector2d(0.0, 0.0) : requests.directions.front();
    if (way[0] == 0.0) {
      // Only one reading lets it stand, if the encoder has it.
      constexpr double whole = 1e-6;
      const double steps = one[0] / step;
      if (std::abs(steps - std::round(steps)) > whole) return;
      Polytope all = in_step(standing, one[0]);
      if (requests.directions.empty()) all.equal(unit(torque), one[1]);
      return include(all);
    }
    const double gain = way[1] / way[0];
    if (gain == 0.0) return include(Polytope(standing).equal(unit(torque), one[1]));
    // All readings between whole ones too.
    Polytope any = standing;
    const Vector4d off = sensed() - unit(torque) / gain;
    const double middle = one[0] - reference_ - one[1] / gain;
    any.between(off, middle - 0.5 * step, middle + 0.5 * step);
    const auto range = any.range_of(unit(torque));
    if (!range) return;
    const auto reading_at = [&](double value) { return (one[0] + (value - one[1]) / gain) / step; };
    const double first = std::ceil(std::min(reading_at(range->low), reading_at(range->high)) - 0.5);
    const double last = std::floor(std::max(reading_at(range->low), reading_at(range->high)) + 0.5);
    // Readings within the range add nothing to its ends.
    constexpr double outer = 64.0;
    for (double reading = first; reading <= last; reading += 1.0) {
      if (reading > first + outer && reading < last - outer) reading = last - outer;
      Polytope all = in_step(standing, reading * step);
      include(all.equal(unit(torque), one[1] + gain * (reading * step - one[0])));
    }
  }

  void include(const Polytope& all) {
    const auto add_to = [&](Extent& extent, const Vector4d& form) {
      if (const auto range = all.range_of(form)) {
        extent.include(range->low);
        extent.include(range->high);
      }
    };
    add_to(load_, unit(load));
    add_to(motor_, unit(load) + unit(gap));
  }

  const ReducedDrive& drive_;
  double reference_;
  double load_torque_;
  Extent load_;
  Extent motor_;
};

}  // namespace

std::optional<Rest> computed_rest(const ReducedDrive& drive) {
  const auto* reference = std::get_if<double>(&drive.reference);
  const auto* load_torque = std::get_if<double>(&drive.load_torque);
  if (reference == nullptr || load_torque == nullptr || !drive::has_linear_control(drive) ||
      std::isfinite(drive.winding.torque_limit)) {
    return std::nullopt;
  }
  Equilibria equilibria(drive, *reference, *load_torque);
  equilibria.find();
  const Extent& load = equilibria.of_load();
  const bool has_ends = load.low > -0.5 * endless && load.high < 0.5 * endless;
  if (!has_ends || load.low > load.high) return std::nullopt;
  return Rest{.load = load,
              .motor = equilibria.of_motor(),
              .error = {-load.high, -load.low},
              .certainty = Certainty::computed};
}

}  // namespace gearlash
