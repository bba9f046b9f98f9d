#include "question/loop/energy/computed_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "model/controller.hpp"
#include "numeric/elimination.hpp"
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

/// z′ by z, or the change of z from tick to tick.
Eigen::MatrixXd velocity_of(const ReducedDrive& drive, const LinearController& controller) {
  Eigen::MatrixXd velocity = matrix_of(controller.state_matrix, controller.order());
  if (drive.sampling) velocity.diagonal().array() -= 1.0;
  return velocity;
}

/// Of z′ = A z + B (r, y) + w (τ − C z − D (r, y)), 0 at rest, or z with a clock, where τ is the
/// limit and w the anti-windup's; empty where no state stands. `limit`: ±torque limit, or none.
std::optional<StandingRequests> standing_requests(const ReducedDrive& drive, double reference,
                                                  std::optional<double> limit) {
  const LinearController controller = drive::running_controller(drive);
  const auto size = static_cast<Eigen::Index>(controller.order());
  const VectorXd output = vector_of(controller.output);
  const Eigen::MatrixXd inputs = matrix_of(controller.input_matrix, 3);
  VectorXd weight = VectorXd::Zero(size);
  if (limit && !controller.anti_windup.empty()) weight = vector_of(controller.anti_windup);
  Eigen::MatrixXd matrix(size, size + 1);  // of the states and the reading
  matrix.leftCols(size) = velocity_of(drive, controller) - weight * output.transpose();
  matrix.col(size) = inputs.col(1) - weight * controller.direct[1];
  const VectorXd right =
      -(inputs.col(0) - weight * controller.direct[0]) * reference - weight * limit.value_or(0.0);
  const std::optional<Solutions> all = all_solutions(matrix, right);
  if (!all) return std::nullopt;
  const auto seen = [&](const VectorXd& solution) {
    double torque = controller.direct[1] * solution[size];
    for (Eigen::Index j = 0; j < size; ++j) torque += output[j] * solution[j];
    return Vector2d(solution[size], torque);
  };
  StandingRequests requests{seen(all->one), {}};
  requests.one[1] += controller.direct[0] * reference;
  constexpr double parallel = 1e-9;
  for (const auto& solution : all->directions.colwise()) {
    const Vector2d direction = seen(VectorXd(solution));
    if (direction.isZero(0.0)) continue;
    const bool is_new = all_of(requests.directions, [&](const auto& known) {
      const double area = known[0] * direction[1] - known[1] * direction[0];
      return std::abs(area) >
             parallel * (std::abs(known[0] * direction[1]) + std::abs(known[1] * direction[0]));
    });
    if (is_new) requests.directions.push_back(direction);
  }
  return requests;
}

/// 1/s or 1 a tick: the rate at which the requested torque rises in the end, for a reading 1 rad
/// above the one with which the controller stands: C v α, where A v = 0 and A z + B_y = α v. 0
/// where the controller has no integral, or more than one.
double winding_rate(const ReducedDrive& drive) {
  const LinearController controller = drive::running_controller(drive);
  const auto size = static_cast<Eigen::Index>(controller.order());
  Eigen::MatrixXd matrix(size, size + 1);
  matrix.leftCols(size) = velocity_of(drive, controller);
  const VectorXd by_reading = -matrix_of(controller.input_matrix, 3).col(1);
  const auto still = all_solutions(matrix.leftCols(size), VectorXd::Zero(size));
  if (size == 0 || !still || still->directions.cols() != 1) return 0.0;
  const VectorXd integral = still->directions.col(0);
  matrix.col(size) = -integral;
  const auto winding = all_solutions(matrix, by_reading);
  if (!winding || winding->directions.row(size).cwiseAbs().sum() > 1e-9) return 0.0;
  double torque = 0.0;
  for (Eigen::Index i = 0; i < size; ++i) {
    torque += controller.output[static_cast<std::size_t>(i)] * integral[i];
  }
  return torque * winding->one[size];
}

// ---- the drive ----------------------------------------------------------------------------------

/// The load's position from the reference, the gap, the mesh torque, the requested torque.
enum Unknown : Eigen::Index { load, gap, mesh, torque, unknowns };

Vector4d unit(Unknown unknown) { return Vector4d::Unit(unknown); }

/// rad. Equilibria that reach this far have no end.
constexpr double endless = 1e6;

enum class Engaged { backward, none, forward };

/// A branch of what the controller receives instead of its error e: gain · e + offset, where
/// low ≤ −e ≤ high.
struct ErrorBranch {
  double gain = 1.0;
  double offset = 0.0;
  double low = -infinity;
  double high = infinity;
};

std::vector<ErrorBranch> branches_of(const drive::ErrorShape& shape) {
  if (!shape.is_present()) return {{}};
  std::vector<ErrorBranch> all;
  if (!shape.is_two_level()) {
    const double half = shape.is_of_speed ? infinity : shape.begins;
    all.push_back({.gain = shape.inner_gain, .low = -half, .high = half});
  }
  for (const double side : {1.0, -1.0}) {  // of the error
    ErrorBranch outer{.gain = shape.outer_gain, .offset = side * shape.offset};
    if (!shape.is_of_speed) {
      (side > 0.0 ? outer.high : outer.low) = -side * shape.ends;
    } else if (shape.ends > 0.0) {
      continue;  // at rest it ends
    }
    all.push_back(outer);
  }
  return all;
}

/// What the motor makes of the requested torque: as it is, or a limit.
struct TorqueLevel {
  double side = 0.0;               ///< of the limit; 0: none acts
  bool is_asked_for_less = false;  ///< the controller knows of the limit
  double applied = 0.0;            ///< N m, of a limit
  double low = -infinity;          ///< N m, of the requested torque
  double high = infinity;
};

std::vector<TorqueLevel> levels_of(const ReducedDrive& drive) {
  const double known = drive.torque_limit;
  const double of_current = drive.winding.torque_limit;
  const double lowest = std::min(known, of_current);
  std::vector<TorqueLevel> all = {{.low = -lowest, .high = lowest}};
  for (const double side : {1.0, -1.0}) {
    const auto add = [&](bool is_known, double from, double to) {
      TorqueLevel level{side, is_known, side * lowest, from, to};
      if (side < 0.0) std::tie(level.low, level.high) = std::pair(-to, -from);
      all.push_back(level);
    };
    if (of_current < known) add(false, of_current, known);
    if (std::isfinite(known)) add(true, known, infinity);
  }
  return all;
}

class Equilibria {
 public:
  Equilibria(const ReducedDrive& drive, double reference, double load_torque)
      : drive_(drive), reference_(reference), load_torque_(load_torque) {}

  /// Those of all contact states, torque limits and branches of the error, merged by kind.
  std::vector<RestPiece> pieces() {
    for (const TorqueLevel& level : levels_of(drive_)) {
      const auto limit =
          level.is_asked_for_less ? std::optional(level.side * drive_.torque_limit) : std::nullopt;
      const auto requests = standing_requests(drive_, reference_, limit);
      for (const ErrorBranch& branch : branches_of(drive_.error_shape)) {
        if (requests) add_with(level, branch, *requests);
        if (!limit || drive::running_controller(drive_).anti_windup.empty())
          add_winding(level, branch);
      }
    }
    return pieces_;
  }

 private:
  void add_with(const TorqueLevel& level, const ErrorBranch& branch,
                const StandingRequests& requests) {
    const bool is_dead = branch.gain == 0.0 && branch.offset == 0.0;
    const auto kind = level.side != 0.0 ? RestKind::torque_limit
                      : is_dead         ? RestKind::dead_band
                                        : RestKind::no_limit;
    load_ = motor_ = Extent();
    if (const auto read = requests_of_readings(branch, requests)) {
      for (const Engaged face : {Engaged::backward, Engaged::none, Engaged::forward}) {
        const bool exists = face == Engaged::none || !drive::is_joined(drive_);
        if (exists) add(standing(face, level), *read, branch);
      }
    }
    if (load_.low <= load_.high) merge(kind, level.side);
  }

  /// Those at a limit behind which the integral winds up for ever.
  void add_winding(const TorqueLevel& level, const ErrorBranch& branch) {
    const double rate = winding_rate(drive_);
    const auto standing_still = standing_requests(drive_, reference_, std::nullopt);
    if (level.side == 0.0 || rate == 0.0 || !standing_still) return;
    const StandingRequests any{standing_still->one, {Vector2d(1.0, 0.0), Vector2d(0.0, 1.0)}};
    if (branch.gain == 0.0) {  // one error, whatever the reading
      if (rate * branch.offset * level.side < 0.0) add_with(level, branch, any);
      return;
    }
    if (!(branch.gain > 0.0)) return;
    ErrorBranch winding = branch;
    const double still = (standing_still->one[0] - reference_ + branch.offset) / branch.gain;
    double& end = rate * level.side > 0.0 ? winding.low : winding.high;
    end = rate * level.side > 0.0 ? std::max(end, still) : std::min(end, still);
    if (winding.low < winding.high) add_with(level, winding, any);
  }

  void merge(RestKind kind, double side) {
    const auto is_alike = [&](const RestPiece& one) {
      return one.kind == kind && one.side == side;
    };
    if (RestPiece* piece = first_of(pieces_, is_alike)) {
      widen(piece->load, load_);
      widen(piece->motor, motor_);
    } else {
      pieces_.push_back({kind, side, load_, motor_});
    }
  }

  /// With the error's branch between reading and controller. Empty if nothing stands on it.
  std::optional<StandingRequests> requests_of_readings(const ErrorBranch& branch,
                                                       const StandingRequests& requests) const {
    StandingRequests read = requests;
    if (branch.gain != 0.0) {
      read.one[0] = reference_ + (requests.one[0] - reference_ + branch.offset) / branch.gain;
      for (Vector2d& direction : read.directions) direction[0] /= branch.gain;
      return read;
    }
    // The controller receives one number, whatever the reading.
    constexpr double rounding = 1e-12;
    const double received = reference_ - branch.offset;
    const double off = received - requests.one[0];
    const Vector2d any_reading(1.0, 0.0);
    read.directions = {any_reading};
    if (any_of(requests.directions, [](const Vector2d& one) { return one[0] == 0.0; })) {
      read.directions.emplace_back(0.0, 1.0);
    }
    const Vector2d* moves =
        first_of(requests.directions, [](const Vector2d& one) { return one[0] != 0.0; });
    if (moves != nullptr) {
      read.one[1] += off / (*moves)[0] * (*moves)[1];
    } else if (std::abs(off) > rounding * (std::abs(received) + std::abs(requests.one[0]))) {
      return std::nullopt;
    }
    return read;
  }

  /// The balance of both shafts, and the contact.
  Polytope standing(Engaged face, const TorqueLevel& level) const {
    Polytope all(unknowns);
    const double load_friction = drive_.load.friction.breakaway;
    const double motor_friction = drive_.motor.friction.breakaway;
    const drive::Gravity& gravity = drive_.gravity;
    const double pulled = load_torque_ - gravity.stiffness * (reference_ - gravity.angle);
    all.between(unit(mesh) - gravity.stiffness * unit(load), -pulled - load_friction,
                -pulled + load_friction);
    if (level.side != 0.0) {
      all.between(unit(mesh), level.applied - motor_friction, level.applied + motor_friction);
    } else {
      all.between(unit(torque) - unit(mesh), -motor_friction, motor_friction);
    }
    all.between(unit(torque), level.low, level.high);
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

  /// Standing, requested and read on a branch of the error.
  void add(const Polytope& standing, const StandingRequests& requests, const ErrorBranch& branch) {
    const double step = drive_.sensing.resolution;
    Polytope all = standing;
    if (step == 0.0) {
      all.between(sensed(), branch.low, branch.high);
      if (requests.directions.size() < 2) ask(requests, all);
      return include(all);
    }
    const double first = std::ceil((reference_ + branch.low) / step - of_a_count);
    const double last = std::floor((reference_ + branch.high) / step + of_a_count);
    if (first > last) return;
    all.between(sensed(), (first - 0.5) * step - reference_, (last + 0.5) * step - reference_);
    if (requests.directions.size() == 2) return include(all);
    add_read(all, requests, first, last);
  }

  /// The requested torque is that of the sensed position.
  void ask(const StandingRequests& requests, Polytope& all) const {
    const Vector2d& one = requests.one;
    if (requests.directions.empty()) {
      all.equal(sensed(), one[0] - reference_).equal(unit(torque), one[1]);
      return;
    }
    const Vector2d& way = requests.directions.front();
    all.equal(way[1] * sensed() - way[0] * unit(torque),
              way[1] * (one[0] - reference_) - way[0] * one[1]);
  }

  /// With an encoder: each of its readings, from `least` to `most` steps, has its own torque, and
  /// its own positions.
  void add_read(const Polytope& standing, const StandingRequests& requests, double least,
                double most) {
    const double step = drive_.sensing.resolution;
    const Vector2d& one = requests.one;
    const auto in_step = [&](Polytope all, double reading) {
      return all.between(sensed(), reading - 0.5 * step - reference_,
                         reading + 0.5 * step - reference_);
    };
    const Vector2d way =
        requests.directions.empty() ? Vector2d(0.0, 0.0) : requests.directions.front();
    if (way[0] == 0.0) {
      // Only one reading lets it stand, if the encoder has it.
      const double steps = one[0] / step;
      if (std::abs(steps - std::round(steps)) > of_a_count) return;
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
    const Extent readings = [&] {
      Extent all;
      all.include(reading_at(range->low));
      all.include(reading_at(range->high));
      return all;
    }();
    const double first = std::max(least, std::ceil(readings.low - 0.5));
    const double last = std::min(most, std::floor(readings.high + 0.5));
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
      const auto range = all.range_of(form);
      if (!range) return;
      // What rounding leaves of forces that cancel is nothing.
      constexpr double rounding = 1e-12;
      const double length =
          std::max({drive_.backlash, std::abs(range->low), std::abs(range->high)});
      for (const double end : {range->low, range->high}) {
        extent.include(std::abs(end) > rounding * length ? end : 0.0);
      }
    };
    add_to(load_, unit(load));
    add_to(motor_, unit(load) + unit(gap));
  }

  /// Of a step: readings nearer than this to a whole one are it.
  static constexpr double of_a_count = 1e-6;

  const ReducedDrive& drive_;
  double reference_;
  double load_torque_;
  Extent load_;  ///< of the equilibria that are being added
  Extent motor_;
  std::vector<RestPiece> pieces_;
};

}  // namespace

std::vector<RestPiece> computed_rest(const ReducedDrive& drive) {
  const auto* reference = std::get_if<double>(&drive.reference);
  const auto* load_torque = std::get_if<double>(&drive.load_torque);
  if (reference == nullptr || load_torque == nullptr || !drive.feedforward.is_absent()) return {};
  std::vector<RestPiece> pieces = Equilibria(drive, *reference, *load_torque).pieces();
  const bool have_ends = all_of(pieces, [](const RestPiece& piece) {
    return piece.load.low > -0.5 * endless && piece.load.high < 0.5 * endless;
  });
  if (!have_ends) pieces.clear();
  return pieces;
}

bool may_hold(const RestPiece& piece, const RestPlace& place) {
  if (!place.uncertainty) return true;
  constexpr double rounding = 1e-9;
  const auto reaches = [&](const Bounds& bounds, double position) {
    const double near =
        *place.uncertainty + rounding * std::max(std::abs(bounds.low), std::abs(bounds.high));
    return bounds.low - near <= position && position <= bounds.high + near;
  };
  return reaches(piece.load, place.load) && (!place.motor || reaches(piece.motor, *place.motor));
}

}  // namespace gearlash
