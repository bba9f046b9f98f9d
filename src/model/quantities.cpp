#include "model/quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

#include "base/lists.hpp"
#include "base/member_path.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {
namespace quantity_rows {
namespace {

using Value = std::optional<double>;

// ---- values -------------------------------------------------------------------------------------

template <class Member>
Value value_of(const Member* member) {
  if (member == nullptr) return std::nullopt;
  if constexpr (std::is_enum_v<Member>) {
    return static_cast<double>(*member);
  } else {
    return *member;
  }
}

/// The member of an answer to which the member pointers lead; see follow().
template <auto... members>
Value at(const Answer& answer) {
  return value_of(follow<members...>(&answer));
}

/// Likewise, of the largest cycle that is not unstable.
template <auto... members>
Value cycle_value(const Answer& answer) {
  return value_of(follow<members...>(answer.largest_stable()));
}

/// Of the motion seen in practice: that cycle, or else an irregular motion.
template <auto member, auto member_of_irregular>
Value motion_value(const Answer& answer) {
  if (answer.largest_stable() != nullptr || answer.irregular.empty()) {
    return cycle_value<member>(answer);
  }
  return value_of(follow<member_of_irregular>(&answer.irregular.front()));
}

/// The same, and 0 without a motion if the drive comes to rest.
template <auto member, auto member_of_irregular>
Value motion_or_rest_value(const Answer& answer) {
  const bool is_quiet =
      answer.verdict == Verdict::cannot_hunt || answer.verdict == Verdict::comes_to_rest;
  if (is_quiet && answer.largest_stable() == nullptr && answer.irregular.empty()) return 0.0;
  return motion_value<member, member_of_irregular>(answer);
}

constexpr auto period = motion_value<&Cycle::period, &IrregularMotion::mean_period>;

Value frequency(const Answer& answer) {
  const Value seconds = period(answer);
  return seconds ? Value(1.0 / *seconds) : std::nullopt;
}

Value static_error(const Answer& answer) {
  if (!answer.rest) return std::nullopt;
  return std::max(std::abs(answer.rest->error.low), std::abs(answer.rest->error.high));
}

Value larger(const Value& a, const Value& b) {
  return a && b ? Value(std::max(*a, *b)) : std::nullopt;
}

/// The error in the end of a start.
Value error_of(const StartOutcome& start, const Answer& answer) {
  if (start.end == "diverges") return infinity;
  if (start.end == "rest") return static_error(answer);
  if (!start.which) return std::nullopt;
  if (start.end == "cycle") return answer.cycles[*start.which].error;
  return answer.irregular[*start.which].error;
}

/// Likewise without a search: the drive rests, or hunts.
Value error_in_closed_form(const Answer& answer, bool is_disturbed) {
  switch (answer.verdict) {
    case Verdict::cannot_hunt:
    case Verdict::comes_to_rest:
      return static_error(answer);
    case Verdict::hunts_if_disturbed:
      if (!is_disturbed) return static_error(answer);
      break;
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
      break;
    case Verdict::grows_without_bound:
      return infinity;
    default:
      return std::nullopt;
  }
  Value error = motion_value<&Cycle::error, &IrregularMotion::error>(answer);
  if (error && answer.rest) error = larger(error, static_error(answer));
  return error;
}

/// Where the smallest displacements of both shafts lead.
Value error(const Answer& answer) {
  if (!answer.search) return error_in_closed_form(answer, false);
  const std::vector<std::size_t> smallest = smallest_starts(*answer.search);
  Value largest = smallest.empty() ? std::nullopt : Value(0.0);
  for (const std::size_t i : smallest) {
    largest = larger(largest, error_of(answer.search->starts[i], answer));
  }
  return largest;
}

/// Where any start leads.
Value error_if_disturbed(const Answer& answer) {
  if (!answer.search) return error_in_closed_form(answer, true);
  if (!answer.search->is_complete || answer.search->starts.empty()) return std::nullopt;
  Value largest = 0.0;
  for (const StartOutcome& start : answer.search->starts) {
    if (start.end == "diverges") return infinity;
    largest = larger(largest, error_of(start, answer));
  }
  return largest;
}

Value energy_fed(const Answer& answer) {
  const EnergyBalance* energy = content_of(follow<&Cycle::energy>(answer.largest_stable()));
  return energy != nullptr ? Value(energy->fed()) : std::nullopt;
}

// ---- the list -----------------------------------------------------------------------------------

struct Unit {
  std::string_view name;
  const Dimension* dimension = nullptr;
};
constexpr Unit none{""};  // of a choice
constexpr Unit one{"1"};
constexpr Unit radian{"rad", &dimensions::angle};
constexpr Unit radian_per_second{"rad/s", &dimensions::angular_speed};
constexpr Unit second{"s", &dimensions::time};
constexpr Unit hertz{"Hz", &dimensions::rate};
constexpr Unit newton_metre{"N m", &dimensions::torque};
constexpr Unit joule{"J"};

constexpr QuantityEntry entry(Quantity quantity, std::string_view name, const Unit& unit,
                              QuantityScope scope, std::string_view meaning,
                              Value (*value)(const Answer&), std::string_view older_name = {}) {
  const QuantityKind kind = unit.name.empty() ? QuantityKind::choice : QuantityKind::number;
  return {{quantity, name, unit.name, meaning, scope, kind}, unit.dimension, value, older_name};
}

using enum QuantityScope;

/// In the order of Quantity.
constexpr std::array entries = {
    entry(Quantity::verdict, "verdict", none, answer, "what the motion of the drive ends in",
          at<&Answer::verdict>),
    entry(Quantity::growth_at_rest, "growth_at_rest", one, answer,
          "growth at rest: the servo hunts when it exceeds 1", at<&Answer::growth_at_rest>),
    entry(Quantity::amplitude, "amplitude", radian, motion,
          "amplitude of the load, half peak-to-peak",
          motion_or_rest_value<&Cycle::amplitude, &IrregularMotion::amplitude>, "size"),
    entry(Quantity::motor_amplitude, "motor_amplitude", radian, motion,
          "amplitude of the motor at the load's shaft, half peak-to-peak",
          motion_or_rest_value<&Cycle::motor_amplitude, &IrregularMotion::motor_amplitude>,
          "motor_size"),
    entry(Quantity::center, "center", radian, motion,
          "mean of the load's extremes, from the reference",
          motion_value<&Cycle::center, &IrregularMotion::center>),
    entry(Quantity::period, "period", second, motion, "period of the limit cycle", period),
    entry(Quantity::frequency, "frequency", hertz, motion, "frequency of the limit cycle",
          frequency),
    entry(Quantity::multiplier, "multiplier", one, motion, "Floquet multiplier over a period",
          cycle_value<&Cycle::multiplier>),
    entry(Quantity::impact_speed, "impact_speed", radian_per_second, motion,
          "relative speed before the hardest impact", cycle_value<&Cycle::impact_speed>),
    entry(Quantity::mesh_torque, "mesh_torque", newton_metre, motion,
          "largest torque between the faces while they are together, at the load's shaft",
          cycle_value<&Cycle::mesh_torque>),
    entry(Quantity::engaged_time, "engaged_time", second, motion,
          "time per period with the faces engaged", cycle_value<&Cycle::engaged_time>),
    entry(Quantity::separated_time, "separated_time", second, motion,
          "time per period with the faces apart", cycle_value<&Cycle::separated_time>),
    entry(Quantity::motor_friction_loss, "motor_friction_loss", joule, motion,
          "energy lost in the motor's viscous friction over a period",
          cycle_value<&Cycle::energy, &EnergyBalance::motor_friction>),
    entry(Quantity::load_friction_loss, "load_friction_loss", joule, motion,
          "energy lost in the load's viscous friction over a period",
          cycle_value<&Cycle::energy, &EnergyBalance::load_friction>),
    entry(Quantity::impact_loss, "impact_loss", joule, motion,
          "energy lost at impacts over a period",
          cycle_value<&Cycle::energy, &EnergyBalance::impacts>),
    entry(Quantity::motor_dry_friction_loss, "motor_dry_friction_loss", joule, motion,
          "energy lost in the motor's dry friction over a period",
          cycle_value<&Cycle::energy, &EnergyBalance::motor_dry_friction>),
    entry(Quantity::load_dry_friction_loss, "load_dry_friction_loss", joule, motion,
          "energy lost in the load's dry friction over a period",
          cycle_value<&Cycle::energy, &EnergyBalance::load_dry_friction>),
    entry(Quantity::contact_loss, "contact_loss", joule, motion,
          "energy lost in compliant faces over a period",
          cycle_value<&Cycle::energy, &EnergyBalance::contact_damping>),
    entry(Quantity::energy_fed, "energy_fed", joule, motion,
          "energy fed by the motor and the load torque over a period", energy_fed),
    entry(Quantity::residual, "residual", one, motion,
          "relative mismatch of the state after one cycle", cycle_value<&Cycle::residual>),
    entry(Quantity::static_error, "static_error", radian, answer,
          "largest error at rest that was found, reference minus load", static_error),
    entry(Quantity::error, "error", radian, answer,
          "largest error in the end, reference minus load, where small disturbances lead", error),
    entry(Quantity::error_if_disturbed, "error_if_disturbed", radian, answer,
          "largest error in the end, reference minus load, wherever a start leads",
          error_if_disturbed),
    entry(Quantity::time_to_rest, "time_to_rest", second, answer,
          "longest time to rest of the starts that were searched",
          at<&Answer::rest, &Rest::time, &TimeToRest::longest>),
    entry(Quantity::ceiling, "ceiling", radian, ceiling,
          "proved bound of the load's motion in the end", at<&Answer::ceiling, &Ceiling::load>),
    entry(Quantity::motor_ceiling, "motor_ceiling", radian, ceiling,
          "proved bound of the motor's motion in the end, at the load's shaft",
          at<&Answer::ceiling, &Ceiling::motor>),
    entry(Quantity::effort_ceiling, "effort_ceiling", newton_metre, ceiling,
          "proved bound of the motor's torque in the end, at the load's shaft",
          at<&Answer::ceiling, &Ceiling::effort>),
    entry(Quantity::bandwidth, "bandwidth", hertz, loop,
          "bandwidth of the linear loop without the gap",
          at<&Answer::loop, &LinearLoop::bandwidth>),
    entry(Quantity::phase_margin, "phase_margin", radian, loop,
          "phase margin of the linear loop without the gap",
          at<&Answer::loop, &LinearLoop::phase_margin>),
    entry(Quantity::gain_margin, "gain_margin", one, loop,
          "factor of the gain at which the linear loop without the gap loses its stability",
          at<&Answer::loop, &LinearLoop::gain_margin>),
    entry(Quantity::lag, "lag", radian, loop,
          "largest error in the end of a moving reference, of the linear loop without the gap",
          at<&Answer::loop, &LinearLoop::lag>),
    entry(Quantity::rise_time, "rise_time", second, step,
          "time in which a step of the reference takes the load from 10 % to 90 %",
          at<&Answer::step, &StepResponse::rise_time>),
    entry(Quantity::overshoot, "overshoot", one, step,
          "by which the load exceeds a step of the reference, as a share of it",
          at<&Answer::step, &StepResponse::overshoot>),
    entry(Quantity::settling_time, "settling_time", second, step,
          "time after which the load stays within the band about a step of the reference",
          at<&Answer::step, &StepResponse::settling_time>)};

constexpr bool are_in_order() {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (static_cast<std::size_t>(entries[i].info.quantity) != i) return false;
  }
  return true;
}
static_assert(are_in_order());

}  // namespace
}  // namespace quantity_rows

using quantity_rows::entries;

std::vector<std::size_t> smallest_starts(const SearchRecord& search) {
  const auto offset = [&](const StartOutcome& start) {
    return std::abs(start.load_position - search.reference);
  };
  double least = infinity;
  for (const StartOutcome& start : search.starts) {
    if (offset(start) > 0.0) least = std::min(least, offset(start));
  }
  constexpr double same = 1.0 + 1e-9;
  std::vector<std::size_t> smallest;
  for (std::size_t i = 0; i < search.starts.size(); ++i) {
    const double here = offset(search.starts[i]);
    if (here > 0.0 && here <= same * least) smallest.push_back(i);
  }
  return smallest;
}

const QuantityEntry& entry_of(Quantity quantity) noexcept {
  return entries[static_cast<std::size_t>(quantity)];
}

std::span<const QuantityInfo> quantities() noexcept {
  static const auto infos = [] {
    std::array<QuantityInfo, entries.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = entries[i].info;
    return all;
  }();
  return infos;
}

const QuantityInfo& info_of(Quantity quantity) noexcept { return entry_of(quantity).info; }

std::string_view name_of(Quantity quantity) noexcept { return info_of(quantity).name; }

std::optional<Quantity> find_quantity(std::string_view name) {
  std::string wanted(name);
  std::replace(wanted.begin(), wanted.end(), '-', '_');
  const QuantityEntry* found = first_of(entries, [&](const QuantityEntry& entry) {
    return wanted == entry.info.name || (!entry.older_name.empty() && wanted == entry.older_name);
  });
  return found == nullptr ? std::nullopt : std::optional(found->info.quantity);
}

std::optional<double> Answer::value(Quantity quantity) const {
  return entry_of(quantity).value(*this);
}

std::optional<RunAway> Answer::runaway() const {
  const std::size_t starts = search ? search->count("diverges") : 0;
  return starts > 0 ? std::optional(RunAway{starts}) : std::nullopt;
}

std::vector<std::pair<std::string_view, std::optional<double>>> Answer::values() const {
  std::vector<std::pair<std::string_view, std::optional<double>>> all;
  for (const QuantityInfo& info : quantities()) {
    if (info.kind == QuantityKind::number) all.emplace_back(info.name, value(info.quantity));
  }
  return all;
}

}  // namespace gearlash
