#include "model/held_torques.hpp"

#include <cstdint>

#include "base/decimal.hpp"
#include "base/number.hpp"

namespace gearlash {
namespace {

Decimal without_last_zeros(Decimal decimal) {
  while (decimal.digits != 0 && decimal.digits % 10 == 0) {
    decimal.digits /= 10;
    ++decimal.exponent;
  }
  return decimal;
}

/// Of decimals that have at most 13 digits in seconds it is then the multiple: another one would be
/// farther off than doubles are apart.
bool is_written_as_multiple(const Sampling& sampling, int periods) {
  if (sampling.delay == static_cast<double>(periods) * sampling.period) return true;
  Decimal period = shortest_decimal(sampling.period);
  period.digits *= static_cast<std::uint64_t>(periods);
  return without_last_zeros(period) == shortest_decimal(sampling.delay);
}

/// By how much a delay exceeds whole periods: of a double that is rounding.
double excess(double) { return 0.0; }
Interval excess(const Interval& time) { return not_negative(time); }

template <class Number>
std::vector<HeldTorqueOf<Number>> held(const Number& period, const Number& whole_delay,
                                       const Sampling& form) {
  const drive::SplitDelay delay = drive::split_delay(form);
  if (delay.rest == 0.0) return {{0.0, period, 0}};
  const auto newest = static_cast<std::size_t>(delay.whole_periods);
  const Number rest = whole_delay - static_cast<double>(delay.whole_periods) * period;
  if (delay.rest < form.period) return {{0.0, rest, newest + 1}, {rest, period, newest}};
  const bool is_exact = is_written_as_multiple(form, delay.whole_periods + 1);
  const Number late = is_exact ? Number(0.0) : excess(rest - period);
  const Number early = is_exact ? Number(0.0) : excess(period - rest);
  std::vector<HeldTorqueOf<Number>> all;
  if (is_above_zero(late)) all.push_back({0.0, late, newest + 2});
  const Number end = is_above_zero(early) ? Number(period - early) : period;
  all.push_back({late, end, newest + 1});
  if (is_above_zero(early)) all.push_back({end, period, newest});
  return all;
}

}  // namespace

std::vector<HeldTorque> held_torques(const Sampling& sampling) {
  return held(sampling.period, sampling.delay, sampling);
}

std::vector<HeldTorqueOf<Interval>> held_torques(const Interval& period, const Interval& delay,
                                                 const Sampling& form) {
  return held(period, delay, form);
}

}  // namespace gearlash
