#include "question/loop/describing/describing_function.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/bracketed_root.hpp"
#include "base/overloaded.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

using Complex = std::complex<double>;

using std::numbers::pi;
constexpr double half_pi = 0.5 * pi;

double squared(double x) { return x * x; }

/// x − sin x, x ≥ 0, to a few epsilons: by its series where the difference would cancel.
double sine_deficit(double x) {
  if (x >= 2.0) return x - std::sin(x);
  double term = x * x * x / 6.0;
  double sum = term;
  for (int k = 4; std::abs(term) > 0.1 * std::numeric_limits<double>::epsilon() * sum; k += 2) {
    term *= -x * x / (k * (k + 1.0));
    sum += term;
  }
  return sum;
}

/// The angle x in [0, π] with x − sin x = deficit.
double angle_of_sine_deficit(double deficit) {
  if (deficit <= 0.0) return 0.0;
  const auto mismatch = [&](double x) {
    return ValueAndSlope{sine_deficit(x) - deficit, 2.0 * squared(std::sin(0.5 * x))};
  };
  return bracketed_root(mismatch, 0.0, pi, std::cbrt(6.0 * deficit), +1.0);
}

/// The angle x with x + sin x = sum, from 0 to slightly above π/2.
double angle_of_sine_sum(double sum) {
  if (sum <= 0.0) return 0.0;
  const auto mismatch = [&](double x) {
    return ValueAndSlope{x + std::sin(x) - sum, 1.0 + std::cos(x)};
  };
  return bracketed_root(mismatch, 0.0, 2.0, 0.5 * sum, +1.0);
}

// ---- Friction-controlled gap: the angle φ, and its supplement ψ = π − φ where that is the
// smaller.

/// N from the angle φ ≤ π/2.
Complex play_gain(double angle) {
  return {0.5 * sine_deficit(2.0 * angle) / pi, -squared(std::sin(angle)) / pi};
}
/// N from the supplement ψ ≤ π/2.
Complex play_gain_of_supplement(double supplement) {
  return {1.0 - 0.5 * sine_deficit(2.0 * supplement) / pi, -squared(std::sin(supplement)) / pi};
}

Complex gain(const FrictionControlledBacklash& backlash, double amplitude) {
  const double half_gap = 0.5 * backlash.gap;
  if (amplitude <= half_gap) return 0.0;
  const double moved = std::sqrt(amplitude - half_gap);
  const double held = std::sqrt(half_gap);
  return moved < held ? play_gain(2.0 * std::atan2(moved, held))
                      : play_gain_of_supplement(2.0 * std::atan2(held, moved));
}

/// dN/dA = −(4h/πA²) j e^{jφ}.
Complex gain_slope(const FrictionControlledBacklash& backlash, double amplitude) {
  const double half_gap = 0.5 * backlash.gap;
  if (amplitude <= half_gap) return 0.0;
  const double share = half_gap / amplitude;
  const double cosine = (half_gap - (amplitude - half_gap)) / amplitude;
  const double sine = 2.0 * std::sqrt(share * ((amplitude - half_gap) / amplitude));
  return 4.0 * share / (pi * amplitude) * Complex{sine, -cosine};
}

/// The angle between N and the negative imaginary axis, which tends to 0 as A → h.
double colag(const Complex& gain) { return std::atan2(gain.real(), -gain.imag()); }
double lag(const Complex& gain) { return std::atan2(-gain.imag(), gain.real()); }

GainPoint play_point_nearer_the_face(double half_gap, const Complex& direction) {
  const double wanted = colag(direction);
  const auto mismatch = [&](double angle) {
    const Complex gain = play_gain(angle);
    const double at_angle = colag(gain);
    return ValueAndSlope{at_angle - wanted, 2.0 * std::sin(angle) * std::sin(angle - at_angle) /
                                                (pi * std::abs(gain))};
  };
  const double angle = bracketed_root(mismatch, 0.0, half_pi, 1.5 * wanted, +1.0);
  return {half_gap / squared(std::cos(0.5 * angle)), play_gain(angle),
          -1.0 / std::tan(angle - wanted)};
}

GainPoint play_point_farther_off(double half_gap, const Complex& direction) {
  const double wanted = lag(direction);
  const auto mismatch = [&](double supplement) {
    const Complex gain = play_gain_of_supplement(supplement);
    const double at_angle = lag(gain);
    return ValueAndSlope{
        at_angle - wanted,
        2.0 * std::sin(supplement) * std::cos(supplement - at_angle) / (pi * std::abs(gain))};
  };
  const double supplement = bracketed_root(mismatch, 0.0, half_pi, std::sqrt(pi * wanted), +1.0);
  return {half_gap / squared(std::sin(0.5 * supplement)), play_gain_of_supplement(supplement),
          std::tan(wanted - supplement)};
}

GainPoint point_in(const FrictionControlledBacklash& backlash, const Complex& direction) {
  constexpr double ratio_in_the_middle = 2.0 / pi;  // N = 1/2 − j/π at φ = π/2
  return -direction.imag() > ratio_in_the_middle * direction.real()
             ? play_point_nearer_the_face(0.5 * backlash.gap, direction)
             : play_point_farther_off(0.5 * backlash.gap, direction);
}

// ---- Inertia-controlled gap: the angle c from parting to contact.

/// Near c = π, Re N is a sum in d = π − c, without cancellation.
Complex coasting_gain(double angle) {
  const double lagging = -4.0 * squared(squared(std::sin(0.5 * angle))) / pi;
  if (angle < half_pi) {
    return {1.0 - (2.0 * sine_deficit(angle) - 0.5 * sine_deficit(2.0 * angle)) / pi, lagging};
  }
  const double left = pi - angle;
  return {(left + 2.0 * std::sin(left) + 0.5 * std::sin(2.0 * left)) / pi, lagging};
}

/// NaN if the other face is not met within half a period.
double coasting_angle(const InertiaControlledBacklash& backlash, double amplitude) {
  const double crossing = backlash.gap / amplitude;
  return crossing <= pi ? angle_of_sine_deficit(crossing) : not_a_number;
}

Complex gain(const InertiaControlledBacklash& backlash, double amplitude) {
  const double angle = coasting_angle(backlash, amplitude);
  return std::isnan(angle) ? Complex{not_a_number, not_a_number} : coasting_gain(angle);
}

/// dN/dA = −(4h/πA²) e^{−jc}.
Complex gain_slope(const InertiaControlledBacklash& backlash, double amplitude) {
  const double angle = coasting_angle(backlash, amplitude);
  return 2.0 * (backlash.gap / amplitude) / (pi * amplitude) *
         Complex{-std::cos(angle), std::sin(angle)};
}

GainPoint point_in(const InertiaControlledBacklash& backlash, const Complex& direction) {
  const double wanted = lag(direction);
  const auto mismatch = [&](double angle) {
    const Complex gain = coasting_gain(angle);
    const double at_angle = lag(gain);
    return ValueAndSlope{at_angle - wanted, 4.0 * squared(std::sin(0.5 * angle)) *
                                                std::sin(angle - at_angle) / (pi * std::abs(gain))};
  };
  const double guess = std::sqrt(std::sqrt(4.0 * pi * wanted));
  const double angle = bracketed_root(mismatch, 0.0, pi, guess, +1.0);
  return {backlash.gap / sine_deficit(angle), coasting_gain(angle), 1.0 / std::tan(angle - wanted)};
}

// ---- Relays

Complex gain(const CoulombFriction& friction, double amplitude) {
  return 4.0 * friction.torque / (pi * amplitude);
}
Complex gain_slope(const CoulombFriction& friction, double amplitude) {
  return -gain(friction, amplitude) / amplitude;
}
std::optional<double> amplitude_of(const CoulombFriction& friction, double gain) {
  return 4.0 * friction.torque / (pi * gain);
}

/// √(1 − ρ²), ρ = width/amplitude, which may be next to 1.
double cosine_of_ratio(double width, double amplitude) {
  return std::sqrt(((amplitude - width) / amplitude) * (1.0 + width / amplitude));
}

Complex gain(const RelayWithHysteresis& relay, double amplitude) {
  if (amplitude < relay.half_width) return 0.0;
  return 4.0 * relay.level / (pi * amplitude) *
         Complex{cosine_of_ratio(relay.half_width, amplitude), -relay.half_width / amplitude};
}

/// With N = (4M/πA)(cos ψ − j sin ψ) and dψ/dA = −tan ψ / A: the real part falls as
/// (1 − tan²ψ) cos ψ / A.
Complex gain_slope(const RelayWithHysteresis& relay, double amplitude) {
  if (amplitude < relay.half_width) return 0.0;
  const double sine = relay.half_width / amplitude;
  const double cosine = cosine_of_ratio(relay.half_width, amplitude);
  return 4.0 * relay.level / (pi * amplitude * amplitude) *
         Complex{(sine - cosine) * (sine + cosine) / cosine, 2.0 * sine};
}

GainPoint point_in(const RelayWithHysteresis& relay, const Complex& direction) {
  const double size = std::abs(direction);
  const double amplitude = relay.half_width * (size / -direction.imag());
  return {amplitude, 4.0 * relay.level / (pi * amplitude) * (direction / size),
          direction.real() / -direction.imag()};
}

std::optional<double> amplitude_of(const RelayWithHysteresis& relay, double gain) {
  return 4.0 * relay.level / (pi * gain);  // has_lag() is false, so half_width is 0
}

// ---- Saturation and dead zone: S(ρ) = (2ψ + sin 2ψ)/π, sin ψ = ρ = corner/A, and 1 − S.

double clipped_share(double corner, double amplitude) {
  const double double_angle = 2.0 * std::asin(corner / amplitude);
  return (double_angle + std::sin(double_angle)) / pi;
}
double passed_share(double corner, double amplitude) {
  const double ratio = corner / amplitude;
  return sine_deficit(2.0 * std::atan2(cosine_of_ratio(corner, amplitude), ratio)) / pi;
}

/// corner/A from S and 1 − S, of which the smaller one is the more accurate.
double ratio_of_share(double share, double rest) {
  return share < 0.5 ? std::sin(0.5 * angle_of_sine_sum(pi * share))
                     : std::cos(0.5 * angle_of_sine_deficit(pi * rest));
}

/// dS/dA.
double share_slope(double corner, double amplitude) {
  return -4.0 * (corner / amplitude) * cosine_of_ratio(corner, amplitude) / (pi * amplitude);
}

double corner_of(const Saturation& saturation) { return saturation.limit / saturation.slope; }

Complex gain(const Saturation& saturation, double amplitude) {
  const double corner = corner_of(saturation);
  return amplitude <= corner ? saturation.slope
                             : saturation.slope * clipped_share(corner, amplitude);
}
Complex gain_slope(const Saturation& saturation, double amplitude) {
  const double corner = corner_of(saturation);
  return amplitude <= corner ? 0.0 : saturation.slope * share_slope(corner, amplitude);
}
std::optional<double> amplitude_of(const Saturation& saturation, double gain) {
  if (gain >= saturation.slope) return std::nullopt;
  return corner_of(saturation) /
         ratio_of_share(gain / saturation.slope, (saturation.slope - gain) / saturation.slope);
}

Complex gain(const DeadZone& zone, double amplitude) {
  return amplitude <= zone.half_width ? 0.0 : zone.slope * passed_share(zone.half_width, amplitude);
}
Complex gain_slope(const DeadZone& zone, double amplitude) {
  return amplitude <= zone.half_width ? 0.0 : -zone.slope * share_slope(zone.half_width, amplitude);
}
std::optional<double> amplitude_of(const DeadZone& zone, double gain) {
  if (gain >= zone.slope) return std::nullopt;
  return zone.half_width / ratio_of_share((zone.slope - gain) / zone.slope, gain / zone.slope);
}

}  // namespace

std::complex<double> describing_gain(const Nonlinearity& nonlinearity, double amplitude) {
  return std::visit([&](const auto& n) { return gain(n, amplitude); }, nonlinearity);
}

std::complex<double> describing_gain_slope(const Nonlinearity& nonlinearity, double amplitude) {
  return std::visit([&](const auto& n) { return gain_slope(n, amplitude); }, nonlinearity);
}

bool has_lag(const Nonlinearity& nonlinearity) {
  return std::visit(Overloaded{
                        [](const FrictionControlledBacklash& n) { return n.gap > 0.0; },
                        [](const InertiaControlledBacklash& n) { return n.gap > 0.0; },
                        [](const RelayWithHysteresis& n) { return n.half_width > 0.0; },
                        [](const auto&) { return false; },
                    },
                    nonlinearity);
}

GainPoint gain_in_direction(const Nonlinearity& nonlinearity, std::complex<double> direction) {
  return std::visit(
      Overloaded{
          [&](const FrictionControlledBacklash& n) { return point_in(n, direction); },
          [&](const InertiaControlledBacklash& n) { return point_in(n, direction); },
          [&](const RelayWithHysteresis& n) { return point_in(n, direction); },
          [](const auto&) {
            return GainPoint{not_a_number, {not_a_number, not_a_number}, not_a_number};
          },
      },
      nonlinearity);
}

std::optional<double> amplitude_of_gain(const Nonlinearity& nonlinearity, double gain) {
  if (!(gain > 0.0)) return std::nullopt;
  return std::visit(Overloaded{
                        // Without a gap they pass every amplitude alike.
                        [](const FrictionControlledBacklash&) { return std::optional<double>{}; },
                        [](const InertiaControlledBacklash&) { return std::optional<double>{}; },
                        [&](const auto& n) { return amplitude_of(n, gain); },
                    },
                    nonlinearity);
}

}  // namespace gearlash
