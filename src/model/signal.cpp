#include "model/signal.hpp"

#include <algorithm>
#include <cmath>

#include "base/overloaded.hpp"
#include "base/range_check.hpp"

namespace gearlash::drive {
namespace {

/// The stretches of a signal over all times. The first begins at −∞; its start is not used.
using Stretches = std::vector<SignalStretch>;

SignalStretch at_rest(double start, double value) { return {start, value, 0.0, 0.0}; }

Stretches all_of(double value) { return {at_rest(0.0, value)}; }

Stretches all_of(const StepSignal& step) {
  return {at_rest(step.time, step.before), at_rest(step.time, step.after)};
}

Stretches all_of(const Ramp& ramp) {
  return {at_rest(ramp.time, ramp.value), {ramp.time, ramp.value, ramp.rate, 0.0}};
}

Stretches all_of(const Trapezoid& move) {
  const double way = move.to < move.from ? -1.0 : 1.0;
  const double distance = std::abs(move.to - move.from);
  if (distance == 0.0) return all_of(move.to);
  // If the distance is too short to reach the speed, deceleration begins at half the distance.
  const double top = std::min(move.speed, std::sqrt(distance * move.acceleration));
  const double rising = top / move.acceleration;
  const double cruising = std::max(0.0, distance / top - rising);
  const double risen_at = move.time + rising;
  const double braking = risen_at + cruising;
  const double risen = 0.5 * top * rising;
  Stretches result = {at_rest(move.time, move.from),
                      {move.time, move.from, 0.0, way * move.acceleration}};
  if (braking > risen_at) {  // rounding may leave a cruise of no time
    result.push_back({risen_at, move.from + way * risen, way * top, 0.0});
  }
  result.push_back({braking, move.to - way * risen, way * top, -way * move.acceleration});
  result.push_back(at_rest(braking + rising, move.to));
  return result;
}

Stretches all_of(const Table& table) {
  Stretches result = {at_rest(table.times.front(), table.values.front())};
  for (std::size_t i = 0; i + 1 < table.times.size(); ++i) {
    const double rate =
        (table.values[i + 1] - table.values[i]) / (table.times[i + 1] - table.times[i]);
    result.push_back({table.times[i], table.values[i], rate, 0.0});
  }
  result.push_back(at_rest(table.times.back(), table.values.back()));
  return result;
}

/// A sine has no stretches.
Stretches all_of(const Sine&) { return {}; }

Stretches all_stretches(const Signal& signal) {
  return std::visit([](const auto& one) { return all_of(one); }, signal);
}

SignalStretch moved_to(const SignalStretch& stretch, double start) {
  const double after = start - stretch.start;
  return {start, stretch.value + after * (stretch.rate + 0.5 * after * stretch.acceleration),
          stretch.rate + after * stretch.acceleration, stretch.acceleration};
}

/// The last stretch that has begun, or the first.
const SignalStretch& stretch_at(const Stretches& all, double time) {
  std::size_t found = 0;
  for (std::size_t i = 1; i < all.size() && all[i].start <= time; ++i) found = i;
  return all[found];
}

void inspect(RangeCheck& check, const Table& table) {
  if (table.times.empty() || table.times.size() != table.values.size()) {
    check.refuse("times",
                 std::to_string(table.times.size()) + " for " +
                     std::to_string(table.values.size()) + " values",
                 "must be as many as values, at least one");
    return;
  }
  if (table.times.size() > most_rows_of_a_table) {
    check.refuse("times", std::to_string(table.times.size()) + " rows",
                 "must be at most " + std::to_string(most_rows_of_a_table) + " rows");
    return;
  }
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    const std::string place = "[" + std::to_string(i) + "]";
    check.finite("times" + place, table.times[i]);
    check.finite("values" + place, table.values[i]);
    if (i > 0 && table.times[i] <= table.times[i - 1]) {
      check.refuse("times" + place, exact_text(table.times[i]),
                   "must be later than the time before it, " + exact_text(table.times[i - 1]));
    }
  }
}

}  // namespace

std::vector<Fault> faults(const Signal& signal, const std::string& field) {
  RangeCheck check(field + ".");
  if (const auto* table = std::get_if<Table>(&signal)) inspect(check, *table);
  return check.faults();
}

double value_at(const Signal& signal, double time) {
  if (const auto* sine = std::get_if<Sine>(&signal)) {
    return sine->mean + sine->amplitude * std::sin(sine->frequency * time + sine->phase);
  }
  return moved_to(stretch_at(all_stretches(signal), time), time).value;
}

Signal shifted(Signal signal, double by) {
  std::visit(Overloaded{[&](double& value) { value += by; },
                        [&](StepSignal& step) {
                          step.before += by;
                          step.after += by;
                        },
                        [&](Ramp& ramp) { ramp.value += by; }, [&](Sine& sine) { sine.mean += by; },
                        [&](Trapezoid& move) {
                          move.from += by;
                          move.to += by;
                        },
                        [&](Table& table) {
                          for (double& value : table.values) value += by;
                        }},
             signal);
  return signal;
}

double middle_of(const Signal& settled_signal) {
  if (const auto* sine = std::get_if<Sine>(&settled_signal)) return sine->mean;
  return value_at(settled_signal, 0.0);
}

Signal settled(const Signal& signal) {
  if (std::holds_alternative<Sine>(signal)) return signal;
  if (const auto* ramp = std::get_if<Ramp>(&signal); ramp != nullptr && ramp->rate != 0.0) {
    return Ramp{ramp->value, ramp->rate, 0.0};
  }
  return all_stretches(signal).back().value;
}

double settling_time(const Signal& signal) {
  const Stretches all = all_stretches(signal);
  return all.size() < 2 ? 0.0 : std::max(0.0, all.back().start);
}

std::vector<SignalStretch> stretches(const Signal& signal) {
  const Stretches all = all_stretches(signal);
  if (all.empty()) return {};
  Stretches result = {moved_to(stretch_at(all, 0.0), 0.0)};
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].start > 0.0) result.push_back(all[i]);
  }
  return result;
}

}  // namespace gearlash::drive
