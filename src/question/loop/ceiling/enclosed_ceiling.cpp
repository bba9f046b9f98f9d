#include "question/loop/ceiling/enclosed_ceiling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "model/parameters.hpp"
#include "model/reduced_drive.hpp"
#include "question/axis.hpp"
#include "question/family/family.hpp"
#include "question/loop/ceiling/ceiling.hpp"

namespace gearlash {
namespace {

using drive::ReducedDrive;

// Parameters in which all numbers of the reduced drive are monotone.

/// The loop keeps its form at 0.
constexpr std::string_view monotone_from_zero[] = {
    "servo.damping",          "servo.friction_ratio",  "motor.friction",  "motor.coulomb",
    "motor.breakaway",        "motor.no_load_current", "gearbox.inertia", "load.friction",
    "load.coulomb",           "load.breakaway",        "load.gravity",    "contact.restitution",
    "controller.proportional"};
constexpr std::string_view monotone_above_zero[] = {"servo.inertia_ratio",
                                                    "servo.backlash",
                                                    "servo.natural_frequency",
                                                    "motor.torque_constant",
                                                    "motor.back_emf_constant",
                                                    "motor.resistance",
                                                    "motor.inductance",
                                                    "motor.torque_per_volt",
                                                    "motor.torque_per_speed",
                                                    "motor.inertia",
                                                    "motor.voltage_limit",
                                                    "motor.torque_limit",
                                                    "motor.current_limit",
                                                    "motor.current_bandwidth",
                                                    "gearbox.ratio",
                                                    "controller.speed_limit",
                                                    "gearbox.backlash",
                                                    "load.inertia",
                                                    "contact.stiffness",
                                                    "sensor.resolution",
                                                    "sensor.counts_per_turn",
                                                    "controller.integral",
                                                    "controller.derivative",
                                                    "controller.filter",
                                                    "controller.tracking_time",
                                                    "controller.position",
                                                    "controller.speed",
                                                    "controller.speed_integral",
                                                    "controller.gain"};

bool is_in(std::span<const std::string_view> paths, std::string_view path) {
  return contains(paths, path);
}

/// Why the side cannot be taken; empty if it can.
std::string obstacle(const Drive& drive, const BoxSide& side) {
  const Parameter* parameter = find_parameter(side.path, drive);
  const std::string_view path = parameter == nullptr ? "" : parameter->path;
  // A computer's filter is not monotone in its time.
  const bool is_computed_filter = path == "controller.filter" && drive.sampling;
  const bool may_be_zero = is_in(monotone_from_zero, path);
  if (is_computed_filter || !(may_be_zero || is_in(monotone_above_zero, path))) {
    return "no proof over values of " + side.path + " is known";
  }
  if (side.values.low < 0.0 || (side.values.low == 0.0 && !may_be_zero)) {
    return "a proof needs values of " + side.path + " above 0";
  }
  return {};
}

bool have_one_form(const EnclosedDrive& enclosed, const EnclosedDrive& widened) {
  const ReducedDrive& one = enclosed.form();
  const ReducedDrive& other = widened.form();
  return one.contact.index() == other.contact.index() &&
         enclosed.controller().order() == widened.controller().order() &&
         drive::is_joined(one) == drive::is_joined(other) &&
         (one.winding.time_constant > 0.0) == (other.winding.time_constant > 0.0) &&
         one.error_shape.is_limit() == other.error_shape.is_limit() &&
         std::isfinite(one.torque_limit) == std::isfinite(other.torque_limit) &&
         std::isfinite(one.winding.torque_limit) == std::isfinite(other.winding.torque_limit);
}

using Sides = std::vector<Bounds>;

std::vector<double> middle_of(const Sides& sides) {
  return of_each(sides, [](const Bounds& side) { return middle_of(side); });
}

Sides sides_of(const std::vector<double>& point) {
  return of_each(point, [](double value) { return Bounds{value, value}; });
}

class Proof {
 public:
  Proof(const Drive& drive, std::span<const BoxSide> box, const CeilingSearch& search,
        Progress& progress)
      : drive_(drive),
        box_(box),
        search_(search),
        progress_(progress),
        whole_(of_each(box, &BoxSide::values)) {
    // Each evaluation takes the time of its corners.
    constexpr std::size_t few_corners = 32;
    const std::size_t corners = std::size_t{1} << box.size();
    if (corners > few_corners) search_.most_evaluations /= corners / few_corners;
  }

  EnclosedCeiling run() {
    const Part whole = evaluated(whole_);
    ++result_.evaluations;
    result_.reason = whole.reason;
    if (whole.is_hopeless) return result_;
    look_at_single_drives();
    measure_widenings();
    parts_ = {whole};
    while (goes_on()) divide();
    result_.parts = parts_.size();
    if (std::isfinite(parts_.front().bound)) {
      result_.bound = parts_.front().bound;
      result_.reason.clear();
    } else if (!has_unbounded_drive_) {
      result_.reason = "bounds over " + std::to_string(result_.evaluations) + " boxes of the " +
                       std::to_string(whole_.size()) +
                       " parameters leave some open: they are too wide for a proof";
    }
    return result_;
  }

 private:
  struct Part {
    Sides sides{};
    double bound = infinity;
    std::string reason{};
    bool is_hopeless = false;  ///< no division helps
  };

  std::optional<double> value_of(const Ceiling& ceiling) const {
    if (search_.quantity == Quantity::motor_ceiling) return ceiling.motor;
    return search_.quantity == Quantity::effort_ceiling ? ceiling.effort : ceiling.load;
  }

  Part evaluated(Sides sides) const {
    Part part{.sides = std::move(sides)};
    std::vector<BoxSide> box(box_.begin(), box_.end());
    for (std::size_t i = 0; i < box.size(); ++i) box[i].values = part.sides[i];
    std::variant<EnclosedDrive, std::string> drives = enclosed_drive(drive_, box);
    if (auto* reason = std::get_if<std::string>(&drives)) {
      part.reason = std::move(*reason);
      part.is_hopeless = true;
      return part;
    }
    const Ceiling ceiling = ceiling_of(std::get<EnclosedDrive>(drives));
    if (const std::optional<double> value = value_of(ceiling)) {
      part.bound = *value;
    } else {
      part.reason = ceiling.load ? ceiling.effort_reason : ceiling.reason;
    }
    return part;
  }

  std::vector<Part> all_evaluated(const std::vector<Sides>& all) {
    result_.evaluations += all.size();
    return of_each_on_threads(all, [&](const Sides& sides) { return evaluated(sides); });
  }

  /// The corners and the middle.
  void look_at_single_drives() {
    std::vector<Sides> points = {sides_of(middle_of(whole_))};
    for (std::size_t corner = 0; corner < std::size_t{1} << whole_.size(); ++corner) {
      points.push_back(sides_of(of_each(indices(whole_.size()), [&](std::size_t i) {
        return (corner >> i & 1U) != 0 ? whole_[i].high : whole_[i].low;
      })));
    }
    for (const Part& part : all_evaluated(points)) {
      if (std::isfinite(part.bound)) {
        result_.largest = std::max(result_.largest.value_or(0.0), part.bound);
      } else {
        has_unbounded_drive_ = true;
        result_.reason = part.reason;
      }
    }
  }

  /// How much wider than its ends the bound is of an eighth of each side about the middle: what
  /// dividing this side gains. Where the ceiling rises or falls all along, nothing.
  void measure_widenings() {
    constexpr double share = 0.125;
    const std::vector<double> middle = middle_of(whole_);
    std::vector<Sides> wanted;
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      const double reach =
          0.5 * share * std::min(whole_[i].high - middle[i], middle[i] - whole_[i].low);
      for (const Bounds& side : {Bounds{middle[i] - reach, middle[i] + reach},
                                 Bounds{middle[i] - reach, middle[i] - reach},
                                 Bounds{middle[i] + reach, middle[i] + reach}}) {
        Sides sides = sides_of(middle);
        sides[i] = side;
        wanted.push_back(std::move(sides));
      }
    }
    const std::vector<Part> parts = all_evaluated(wanted);
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      const double ends = std::max(parts[3 * i + 1].bound, parts[3 * i + 2].bound);
      const double wider = parts[3 * i].bound / ends - 1.0;
      // Not bounded: by the width alone, which divides these sides first.
      widenings_.push_back(std::isfinite(wider) ? std::max(wider, 1e-9) : 1e3);
    }
  }

  bool goes_on() {
    if (has_unbounded_drive_) return false;
    const double bound = parts_.front().bound;
    const double largest = result_.largest.value_or(0.0);
    if (search_.limit && (bound <= *search_.limit || largest > *search_.limit)) return false;
    if (!search_.limit && bound <= (1.0 + search_.close) * largest) return false;
    if (result_.evaluations >= search_.most_evaluations) return false;
    const double share =
        static_cast<double>(result_.evaluations) / static_cast<double>(search_.most_evaluations);
    result_.stopped = !progress_.go_on(share);
    return !result_.stopped;
  }

  std::array<Sides, 2> halves_of(const Part& part) const {
    std::size_t widest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      const double all = whole_[i].high - whole_[i].low;
      const double share = all > 0.0 ? (part.sides[i].high - part.sides[i].low) / all : 0.0;
      if (share * widenings_[i] > most) {
        most = share * widenings_[i];
        widest = i;
      }
    }
    std::array<Sides, 2> halves = {part.sides, part.sides};
    const double middle = middle_of(part.sides[widest]);
    halves[0][widest].high = halves[1][widest].low = middle;
    return halves;
  }

  /// Halves the parts with the largest bounds. The parts fall.
  void divide() {
    constexpr std::size_t at_a_time = 16;
    const std::size_t count = std::min(at_a_time, parts_.size());
    std::vector<Sides> halves;
    for (std::size_t i = 0; i < count; ++i) {
      add_all(halves, halves_of(parts_[i]));
    }
    std::vector<Part> parts = all_evaluated(halves);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      // What is proved of the whole holds of its half.
      parts[i].bound = std::min(parts[i].bound, parts_[i / 2].bound);
    }
    parts_.erase(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(count));
    add_all(parts_, parts);
    sort_by(parts_, [](const Part& part) { return -part.bound; });
  }

  const Drive& drive_;
  std::span<const BoxSide> box_;
  CeilingSearch search_;
  Progress& progress_;
  Sides whole_;
  std::vector<double> widenings_;
  std::vector<Part> parts_;
  bool has_unbounded_drive_ = false;
  EnclosedCeiling result_;
};

}  // namespace

double middle_of(const Bounds& side) {
  return side.low > 0.0 && side.high > 2.0 * side.low ? std::sqrt(side.low) * std::sqrt(side.high)
                                                      : side.low + 0.5 * (side.high - side.low);
}

std::variant<EnclosedDrive, std::string> enclosed_drive(const Drive& drive,
                                                        std::span<const BoxSide> box) {
  if (drive.controller.firmware) return std::string("no proof over registers is known");
  if (box.size() > most_sides) {
    return "more than " + std::to_string(most_sides) + " parameters vary";
  }
  for (const BoxSide& side : box) {
    if (side.values.low == side.values.high) continue;
    if (std::string reason = obstacle(drive, side); !reason.empty()) return reason;
  }
  std::optional<EnclosedDrive> all;
  for (const std::vector<double>& corner : corners_of(of_each(box, &BoxSide::values))) {
    Drive at_corner = drive;
    for (std::size_t i = 0; i < box.size(); ++i) {
      set_on({.path = box[i].path}, at_corner, corner[i]);
    }
    if (!faults(at_corner).empty()) return std::string("some drives of the box are unsound");
    const EnclosedDrive one(at_corner);
    if (!all) all = one;
    if (!have_one_form(*all, one)) return std::string("the loop changes its form within the box");
    all->widen_to(one);
  }
  return *std::move(all);
}

EnclosedCeiling enclosed_ceiling(const Drive& drive, std::span<const BoxSide> box,
                                 const CeilingSearch& search, Progress& progress) {
  return Proof(drive, box, search, progress).run();
}

}  // namespace gearlash
