#include "model/quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace gearlash {
namespace {

using Value = std::optional<double>;

/// The motion seen in practice: a cycle, or an irregular motion.
struct Seen {
  const Cycle* cycle = nullptr;
  const IrregularMotion* irregular = nullptr;
};

Seen seen_in(const Answer& answer) {
  if (const Cycle* cycle = answer.largest_stable()) return {cycle, nullptr};
  return {nullptr, answer.irregular.empty() ? nullptr : &answer.irregular.front()};
}

bool is_quiet(const Answer& answer) {
  return answer.verdict == Verdict::cannot_hunt || answer.verdict == Verdict::comes_to_rest;
}

template <auto member>
Value of_cycle(const Answer& answer) {
  const Seen seen = seen_in(answer);
  return seen.cycle != nullptr ? Value(seen.cycle->*member) : std::nullopt;
}

template <auto member>
Value of_energy(const Answer& answer) {
  const Seen seen = seen_in(answer);
  if (seen.cycle == nullptr || !seen.cycle->energy) return std::nullopt;
  return (*seen.cycle->energy).*member;
}

Value amplitude_of(const Answer& answer) {
  const Seen seen = seen_in(answer);
  if (seen.cycle != nullptr) return seen.cycle->amplitude;
  if (seen.irregular != nullptr) return seen.irregular->amplitude;
  return is_quiet(answer) ? Value(0.0) : std::nullopt;
}

Value motor_amplitude_of(const Answer& answer) {
  const Seen seen = seen_in(answer);
  if (seen.cycle != nullptr) return seen.cycle->motor_amplitude;
  if (seen.irregular != nullptr) return seen.irregular->motor_amplitude;
  return is_quiet(answer) ? Value(0.0) : std::nullopt;
}

Value center_of(const Answer& answer) {
  const Seen seen = seen_in(answer);
  if (seen.cycle != nullptr) return seen.cycle->center;
  return seen.irregular != nullptr ? Value(seen.irregular->center) : std::nullopt;
}

Value period_of(const Answer& answer) {
  const Seen seen = seen_in(answer);
  if (seen.cycle != nullptr) return seen.cycle->period;
  return seen.irregular != nullptr ? seen.irregular->mean_period : std::nullopt;
}

Value frequency_of(const Answer& answer) {
  const Value period = period_of(answer);
  return period ? Value(1.0 / *period) : std::nullopt;
}

Value static_error_of(const Answer& answer) {
  if (!answer.rest) return std::nullopt;
  return std::max(std::abs(answer.rest->error.low), std::abs(answer.rest->error.high));
}

Value time_to_rest_of(const Answer& answer) {
  return answer.rest && answer.rest->time ? Value(answer.rest->time->longest) : std::nullopt;
}

template <auto member>
Value of_ceiling(const Answer& answer) {
  return answer.ceiling ? (*answer.ceiling).*member : std::nullopt;
}

template <auto member>
Value of_loop(const Answer& answer) {
  return answer.loop ? (*answer.loop).*member : std::nullopt;
}

template <auto member>
Value of_step(const Answer& answer) {
  return answer.step ? (*answer.step).*member : std::nullopt;
}

constexpr auto of_answer = QuantityScope::answer;
constexpr auto of_motion = QuantityScope::motion;
constexpr auto number = QuantityKind::number;

/// In the order of Quantity.
constexpr std::array entries = {
    QuantityEntry{
        .info = {Quantity::verdict, "verdict", "", "what the motion of the drive ends in",
                 of_answer, QuantityKind::choice},
        .value = [](const Answer& answer) -> Value { return static_cast<double>(answer.verdict); }},
    QuantityEntry{.info = {Quantity::growth_at_rest, "growth_at_rest", "1",
                           "growth at rest: the servo hunts when it exceeds 1", of_answer, number},
                  .value = [](const Answer& answer) { return answer.growth_at_rest; }},
    QuantityEntry{.info = {Quantity::amplitude, "amplitude", "rad",
                           "amplitude of the load, half peak-to-peak", of_motion, number},
                  .dimension = &dimensions::angle,
                  .value = amplitude_of,
                  .older_name = "size"},
    QuantityEntry{.info = {Quantity::motor_amplitude, "motor_amplitude", "rad",
                           "amplitude of the motor at the load's shaft, half peak-to-peak",
                           of_motion, number},
                  .dimension = &dimensions::angle,
                  .value = motor_amplitude_of,
                  .older_name = "motor_size"},
    QuantityEntry{.info = {Quantity::center, "center", "rad",
                           "mean of the load's extremes, from the reference", of_motion, number},
                  .dimension = &dimensions::angle,
                  .value = center_of},
    QuantityEntry{
        .info = {Quantity::period, "period", "s", "period of the limit cycle", of_motion, number},
        .dimension = &dimensions::time,
        .value = period_of},
    QuantityEntry{.info = {Quantity::frequency, "frequency", "Hz", "frequency of the limit cycle",
                           of_motion, number},
                  .dimension = &dimensions::rate,
                  .value = frequency_of},
    QuantityEntry{.info = {Quantity::multiplier, "multiplier", "1",
                           "Floquet multiplier over a period", of_motion, number},
                  .value = of_cycle<&Cycle::multiplier>},
    QuantityEntry{.info = {Quantity::impact_speed, "impact_speed", "rad/s",
                           "relative speed before the hardest impact", of_motion, number},
                  .dimension = &dimensions::angular_speed,
                  .value = of_cycle<&Cycle::impact_speed>},
    QuantityEntry{.info = {Quantity::engaged_time, "engaged_time", "s",
                           "time per period with the faces engaged", of_motion, number},
                  .dimension = &dimensions::time,
                  .value = of_cycle<&Cycle::engaged_time>},
    QuantityEntry{.info = {Quantity::separated_time, "separated_time", "s",
                           "time per period with the faces apart", of_motion, number},
                  .dimension = &dimensions::time,
                  .value = of_cycle<&Cycle::separated_time>},
    QuantityEntry{.info = {Quantity::motor_friction_loss, "motor_friction_loss", "J",
                           "energy lost in the motor's friction over a period", of_motion, number},
                  .value = of_energy<&EnergyLost::motor_friction>},
    QuantityEntry{.info = {Quantity::load_friction_loss, "load_friction_loss", "J",
                           "energy lost in the load's friction over a period", of_motion, number},
                  .value = of_energy<&EnergyLost::load_friction>},
    QuantityEntry{.info = {Quantity::impact_loss, "impact_loss", "J",
                           "energy lost at impacts over a period", of_motion, number},
                  .value = of_energy<&EnergyLost::impacts>},
    QuantityEntry{.info = {Quantity::residual, "residual", "1",
                           "relative mismatch of the state after one cycle", of_motion, number},
                  .value = of_cycle<&Cycle::residual>},
    QuantityEntry{
        .info = {Quantity::static_error, "static_error", "rad",
                 "largest error at rest that was found, reference minus load", of_answer, number},
        .dimension = &dimensions::angle,
        .value = static_error_of},
    QuantityEntry{
        .info = {Quantity::time_to_rest, "time_to_rest", "s",
                 "longest time to rest of the starts that were searched", of_answer, number},
        .dimension = &dimensions::time,
        .value = time_to_rest_of},
    QuantityEntry{
        .info = {Quantity::ceiling, "ceiling", "rad",
                 "proved bound of the load's motion in the end", QuantityScope::ceiling, number},
        .dimension = &dimensions::angle,
        .value = of_ceiling<&Ceiling::load>},
    QuantityEntry{.info = {Quantity::motor_ceiling, "motor_ceiling", "rad",
                           "proved bound of the motor's motion in the end, at the load's shaft",
                           QuantityScope::ceiling, number},
                  .dimension = &dimensions::angle,
                  .value = of_ceiling<&Ceiling::motor>},
    QuantityEntry{.info = {Quantity::effort_ceiling, "effort_ceiling", "N m",
                           "proved bound of the motor's torque in the end, at the load's shaft",
                           QuantityScope::ceiling, number},
                  .dimension = &dimensions::torque,
                  .value = of_ceiling<&Ceiling::effort>},
    QuantityEntry{
        .info = {Quantity::bandwidth, "bandwidth", "Hz",
                 "bandwidth of the linear loop without the gap", QuantityScope::loop, number},
        .dimension = &dimensions::rate,
        .value = of_loop<&LinearLoop::bandwidth>},
    QuantityEntry{
        .info = {Quantity::phase_margin, "phase_margin", "rad",
                 "phase margin of the linear loop without the gap", QuantityScope::loop, number},
        .dimension = &dimensions::angle,
        .value = of_loop<&LinearLoop::phase_margin>},
    QuantityEntry{.info = {Quantity::rise_time, "rise_time", "s",
                           "time in which a step of the reference takes the load from 10 % to 90 %",
                           QuantityScope::step, number},
                  .dimension = &dimensions::time,
                  .value = of_step<&StepResponse::rise_time>},
    QuantityEntry{.info = {Quantity::overshoot, "overshoot", "1",
                           "by which the load exceeds a step of the reference, as a share of it",
                           QuantityScope::step, number},
                  .value = of_step<&StepResponse::overshoot>},
    QuantityEntry{.info = {Quantity::settling_time, "settling_time", "s",
                           "time after which the load stays within 5 % of a step of the reference",
                           QuantityScope::step, number},
                  .dimension = &dimensions::time,
                  .value = of_step<&StepResponse::settling_time>}};

constexpr bool are_in_order() {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (static_cast<std::size_t>(entries[i].info.quantity) != i) return false;
  }
  return true;
}
static_assert(are_in_order());

}  // namespace

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
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const QuantityEntry& entry) {
    return wanted == entry.info.name || (!entry.older_name.empty() && wanted == entry.older_name);
  });
  return found == entries.end() ? std::nullopt : std::optional(found->info.quantity);
}

std::optional<double> Answer::value(Quantity quantity) const {
  return entry_of(quantity).value(*this);
}

}  // namespace gearlash
