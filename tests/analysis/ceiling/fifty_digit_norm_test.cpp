// Ceilings beside ∫|g| in fifty digits, of transfer functions that are written down by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_complex.hpp>
#include <cmath>
#include <complex>
#include <cstdio>
#include <string>
#include <vector>

#include "analysis/ceiling/ceiling.hpp"
#include "base/fifty_digits.hpp"
#include "base/seeded_draws.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::fifty_digit_norm_test {
namespace {

using drive::ReducedDrive;
using WideComplex = boost::multiprecision::cpp_complex_50;
using Polynomial = std::vector<Wide>;  // by ascending powers

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial result(a.size() + b.size() - 1, Wide(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}
Polynomial sum(Polynomial a, const Polynomial& b) {
  if (a.size() < b.size()) a.resize(b.size(), Wide(0));
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += b[i];
  return a;
}
Polynomial scaled(const Wide& factor, Polynomial a) {
  for (Wide& one : a) one *= factor;
  return a;
}

WideComplex value(const Polynomial& a, const WideComplex& s) {
  WideComplex result(0);
  for (std::size_t i = a.size(); i-- > 0;) result = result * s + a[i];
  return result;
}

Polynomial derivative(const Polynomial& a) {
  Polynomial result;
  for (std::size_t i = 1; i < a.size(); ++i) result.push_back(a[i] * static_cast<int>(i));
  return result;
}

/// By Durand and Kerner's iteration.
std::vector<WideComplex> roots_of(const Polynomial& given) {
  const Polynomial a = scaled(1 / given.back(), given);
  const std::size_t order = a.size() - 1;
  const double radius = std::pow(std::max(1e-12, std::abs(static_cast<double>(a[0]))),
                                 1.0 / static_cast<double>(order));
  std::vector<WideComplex> roots;
  for (std::size_t i = 0; i < order; ++i) {
    const std::complex<double> start =
        std::polar(radius, 0.4 + 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(order));
    roots.emplace_back(start.real(), start.imag());
  }
  for (int step = 0; step < 400; ++step) {
    Wide moved = 0;
    for (std::size_t i = 0; i < order; ++i) {
      WideComplex others(1);
      for (std::size_t j = 0; j < order; ++j) {
        if (j != i) others *= roots[i] - roots[j];
      }
      const WideComplex change = value(a, roots[i]) / others;
      roots[i] -= change;
      moved = std::max(moved, Wide(abs(change) / abs(roots[i])));
    }
    if (moved < Wide("1e-45")) break;
  }
  return roots;
}

/// |G(∞)| + ∫|g| of G = numerator/denominator, whose poles are simple.
class Norm {
 public:
  Norm(const Polynomial& numerator, const Polynomial& denominator) {
    const std::size_t order = denominator.size() - 1;
    const Wide at_infinity = numerator.size() > order ? numerator[order] / denominator[order] : 0;
    const Polynomial rest = sum(numerator, scaled(-at_infinity, denominator));
    const Polynomial slope = derivative(denominator);
    for (const WideComplex& pole : roots_of(denominator)) {
      terms_.push_back({pole, value(rest, pole) / value(slope, pole)});
      fastest_ = std::max(fastest_, static_cast<double>(abs(pole)));
      slowest_ = std::min(slowest_, -static_cast<double>(pole.real()));
    }
    at_once_ = static_cast<double>(abs(at_infinity));
  }

  bool decays() const { return slowest_ > 0.0; }
  bool is_quick() const { return fastest_ < 3e3 * slowest_; }

  double total() const {
    std::vector<double> changes = sign_changes();
    Wide sum = 0;
    Wide last = integral(0.0);
    for (const double time : changes) {
      const Wide here = integral(time);
      sum += abs(here - last);
      last = here;
    }
    return at_once_ + static_cast<double>(sum + abs(last));  // the integral tends to 0
  }

 private:
  struct Term {
    WideComplex pole;
    WideComplex residue;
  };
  /// −∫ from the time on.
  Wide integral(double time) const {
    WideComplex sum(0);
    for (const Term& term : terms_) sum += term.residue / term.pole * exp(term.pole * time);
    return sum.real();
  }
  double impulse(double time) const {
    std::complex<double> sum = 0.0;
    for (const Term& term : terms_) {
      const std::complex<double> pole(static_cast<double>(term.pole.real()),
                                      static_cast<double>(term.pole.imag()));
      const std::complex<double> residue(static_cast<double>(term.residue.real()),
                                         static_cast<double>(term.residue.imag()));
      sum += residue * std::exp(pole * time);
    }
    return sum.real();
  }
  /// A wrong place changes the integral by its square.
  std::vector<double> sign_changes() const {
    const double step = 0.05 / fastest_;
    const double end = 30.0 / slowest_;
    std::vector<double> changes;
    double before = impulse(0.0);
    for (double time = step; time < end; time += step) {
      const double now = impulse(time);
      if (now * before < 0.0) {
        double low = time - step;
        double high = time;
        for (int i = 0; i < 40; ++i) {
          const double middle = 0.5 * (low + high);
          (impulse(middle) * before > 0.0 ? low : high) = middle;
        }
        changes.push_back(high);
      }
      before = now;
    }
    return changes;
  }

  std::vector<Term> terms_;
  double at_once_ = 0.0;
  double fastest_ = 0.0;
  double slowest_ = infinity;
};

/// τ = −(position y + speed v)/denominator.
struct ControlLaw {
  Polynomial position;
  Polynomial speed;
  Polynomial denominator;
};

struct RandomLoop {
  ReducedDrive drive{};
  ControlLaw law{};
};

/// PD and PID with a filtered derivative, cascades and lead-lag elements; windings and weights.
RandomLoop random_loop(SeededDraws& draws) {
  RandomLoop random;
  ReducedDrive& drive = random.drive;
  drive.motor = {draws.log_uniform(0.1, 2.0), {.viscous = draws.log_uniform(0.01, 0.5)}};
  drive.load = {draws.log_uniform(0.1, 2.0), {.viscous = draws.log_uniform(0.01, 0.5)}};
  drive.backlash = 2.0;
  drive.sensing = {.load_share_of_position = draws.one_of({0.0, 1.0}),
                   .load_share_of_speed = draws.one_of({0.0, 1.0})};
  if (draws.happens(0.4)) {
    drive.winding = {.time_constant = draws.log_uniform(0.01, 0.5),
                     .back_emf = draws.log_uniform(0.01, 0.5)};
  }
  if (draws.happens(0.3)) drive.gravity.stiffness = draws.uniform(-0.2, 0.5);
  const double proportional = draws.log_uniform(0.3, 3.0);
  const double derivative = draws.log_uniform(0.2, 2.0);
  const double integral = draws.log_uniform(0.02, 0.3);
  const double filter = draws.log_uniform(0.02, 0.3);
  const double kind = draws.uniform(0.0, 3.0);
  const Polynomial filtered{1, Wide(filter)};
  if (kind < 1.0) {
    drive.controller = drive::ProportionalIntegralDerivative{.proportional = proportional,
                                                             .integral = integral,
                                                             .derivative = derivative,
                                                             .filter = filter};
    random.law = {
        sum(product({Wide(integral), Wide(proportional)}, filtered), {0, 0, Wide(derivative)}),
        {0},
        product({0, 1}, filtered)};
  } else if (kind < 2.0) {
    drive.controller =
        drive::Cascade{.position = proportional, .speed = derivative, .speed_integral = integral};
    const Polynomial of_speed{Wide(integral), Wide(derivative)};
    random.law = {scaled(Wide(proportional), of_speed), of_speed, {0, 1}};
  } else {
    const double zero = draws.log_uniform(0.3, 1.0);
    const double pole = zero * draws.log_uniform(3.0, 30.0);
    drive.controller = drive::LeadLag{.gain = proportional, .zero = zero, .pole = pole};
    random.law = {scaled(Wide(proportional), {1, 1 / Wide(zero)}), {0}, {1, 1 / Wide(pole)}};
  }
  return random;
}

/// Of the load (and + 1 of the motor) from the gap.
Norm norm_of(const RandomLoop& loop, bool is_motor) {
  const ReducedDrive& drive = loop.drive;
  Polynomial lag{1};
  if (drive.winding.time_constant > 0.0) lag.push_back(Wide(drive.winding.time_constant));
  const Polynomial common = product(lag, loop.law.denominator);
  const auto shaft = [&](const drive::Shaft& one) {
    return product({0, Wide(one.friction.viscous), Wide(one.inertia)}, common);
  };
  const Polynomial back_emf =
      scaled(Wide(drive.winding.back_emf), product({0, 1}, loop.law.denominator));
  const Polynomial motor = sum(shaft(drive.motor), back_emf);
  const Polynomial of_speed = product({0, 1}, loop.law.speed);
  const Polynomial open =
      sum(motor, sum(scaled(Wide(1.0 - drive.sensing.load_share_of_position), loop.law.position),
                     scaled(Wide(1.0 - drive.sensing.load_share_of_speed), of_speed)));
  const Polynomial closed =
      sum(sum(motor, shaft(drive.load)),
          sum(scaled(Wide(drive.gravity.stiffness), common), sum(loop.law.position, of_speed)));
  const Polynomial of_load = scaled(-1, open);
  return {is_motor ? sum(of_load, closed) : of_load, closed};
}

TEST(OracleCeiling, IsTheNormInFiftyDigitsOfRandomLoops) {
  constexpr std::uint64_t seed = 19601123;
  SeededDraws draws(seed);
  int proved = 0;
  double loosest = 1.0;
  for (int i = 0; i < 60; ++i) {
    const RandomLoop loop = random_loop(draws);
    const Norm of_load = norm_of(loop, false);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", loop " + std::to_string(i));
    const Ceiling ceiling = ceiling_of(loop.drive);
    EXPECT_EQ(ceiling.load.has_value(), of_load.decays());
    if (!ceiling.load || !of_load.is_quick()) continue;
    ++proved;
    const double load = of_load.total();
    const double motor = norm_of(loop, true).total();
    EXPECT_GE(*ceiling.load, load * (1.0 - 1e-12));
    EXPECT_GE(*ceiling.motor, motor * (1.0 - 1e-12));
    EXPECT_LE(*ceiling.load, load * 1.0001);
    EXPECT_LE(*ceiling.motor, motor * 1.0001);
    loosest = std::max({loosest, *ceiling.load / load, *ceiling.motor / motor});
  }
  std::printf("%d loops; the certificate is at most %.2e above the norm\n", proved, loosest - 1.0);
  EXPECT_GT(proved, 35);
}

/// The sample servo of the thesis, and three of its neighbours: to four digits.
TEST(OracleCeiling, OfTheSampleServoAndItsNeighboursInBacklashes) {
  struct Known {
    double damping, inertia_ratio, friction_ratio, ceiling;
  };
  for (const Known& known :
       {Known{0.18861093889995897, 1.992976605137472, 0.07710100231303006, 0.8674},
        Known{0.19, 2.0, 0.1, 0.8542}, Known{0.1, 1.0, 0.2, 1.8597},
        Known{0.4, 4.0, 0.2, 0.5466}}) {
    EXPECT_NEAR(
        *ceiling_of(reduce(normal_form(known.damping, known.inertia_ratio, known.friction_ratio)))
             .load,
        known.ceiling, 6e-5);
  }
}

}  // namespace
}  // namespace gearlash::fifty_digit_norm_test
