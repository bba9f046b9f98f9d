#include "model/rational_function.hpp"

#include <utility>

#include "model/number_members.hpp"
#include "numeric/transfer_polynomials.hpp"

namespace gearlash::drive {
namespace {

/// Euclid's algorithm, with monic remainders so that their coefficients stay short.
Polynomial greatest_common_divisor(Polynomial a, Polynomial b) {
  while (!b.is_zero()) {
    Polynomial remainder = a % b;
    if (!remainder.is_zero()) remainder /= Rational(remainder.data().back());
    a = std::exchange(b, std::move(remainder));
  }
  return a;
}

Polynomial one() { return Polynomial(Rational(1)); }

std::vector<double> descending(const Polynomial& polynomial) {
  std::vector<double> coefficients;
  for (auto i = polynomial.data().rbegin(); i != polynomial.data().rend(); ++i) {
    coefficients.push_back(i->convert_to<double>());
  }
  if (coefficients.empty()) coefficients.push_back(0.0);
  return coefficients;
}

/// By Horner's rule.
RationalFunction value_at(const Polynomial& polynomial, const RationalFunction& argument) {
  RationalFunction value;
  for (auto i = polynomial.data().rbegin(); i != polynomial.data().rend(); ++i) {
    value = value * argument + RationalFunction(*i);
  }
  return value;
}

}  // namespace

RationalFunction::RationalFunction(const Rational& constant)
    : numerator_(constant), denominator_(one()) {
  numerator_.normalize();  // 0 has no coefficients
}

RationalFunction::RationalFunction(Polynomial numerator, Polynomial denominator)
    : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {
  numerator_.normalize();
  denominator_.normalize();
  const Polynomial divisor = greatest_common_divisor(denominator_, numerator_);
  if (divisor.degree() > 0) {
    numerator_ /= divisor;
    denominator_ /= divisor;
  }
  const Rational lead = denominator_.data().back();
  numerator_ /= lead;
  denominator_ /= lead;
}

RationalFunction operator+(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator() * b.denominator() + b.numerator() * a.denominator(),
          a.denominator() * b.denominator()};
}

RationalFunction operator-(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator() * b.denominator() - b.numerator() * a.denominator(),
          a.denominator() * b.denominator()};
}

RationalFunction operator*(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator() * b.numerator(), a.denominator() * b.denominator()};
}

RationalFunction operator/(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator() * b.denominator(), a.denominator() * b.numerator()};
}

RationalFunction variable() { return {Polynomial{Rational(0), Rational(1)}, one()}; }

RationalFunction composed(const RationalFunction& function, const RationalFunction& argument) {
  return value_at(function.numerator(), argument) / value_at(function.denominator(), argument);
}

RationalFunction delay_approximation(double delay) {
  constexpr int order = 4;
  // The coefficient of xᵏ is (2n − k)! n!/((2n)! k! (n − k)!), each from the one before.
  std::vector<Rational> ahead = {Rational(1)};
  std::vector<Rational> behind = {Rational(1)};
  Rational coefficient = 1;
  for (int k = 1; k <= order; ++k) {
    coefficient *= Rational(delay) * Rational(order - k + 1, k * (2 * order - k + 1));
    behind.push_back(coefficient);
    ahead.push_back(k % 2 == 0 ? coefficient : Rational(-coefficient));
  }
  return {Polynomial(std::move(ahead)), Polynomial(std::move(behind))};
}

TransferFunction rounded(const RationalFunction& function, double delay) {
  return {descending(function.numerator()), descending(function.denominator()), delay};
}

// ---- controllers --------------------------------------------------------------------------------

namespace {

/// A controller with the anti-windup, if it acts, as one of its inputs:
///   τ − τ_asked = τ − output z − direct u.
LinearControllerOf<Rational> exact(const LinearController& given, TorqueGiven torque) {
  const bool winds_back = torque == TorqueGiven::limited && !given.anti_windup.empty();
  LinearControllerOf<Rational> result;
  set_numbers([](double from, Rational& to) { to = from; }, given, result);
  for (std::size_t i = 0; i < result.order(); ++i) {
    const Rational draw = winds_back ? result.anti_windup[i] : Rational(0);
    for (std::size_t j = 0; j < result.order(); ++j) {
      result.state_matrix[i][j] -= draw * result.output[j];
    }
    for (std::size_t j = 0; j < 3; ++j) result.input_matrix[i][j] -= draw * result.direct[j];
    result.input_matrix[i].push_back(draw);
  }
  result.direct.emplace_back(0);
  return result;
}

}  // namespace

ExactControllerTransfer exact_transfer(const LinearController& controller, TorqueGiven torque) {
  const TransferPolynomials<Rational> found = transfer_polynomials(exact(controller, torque));
  const auto transfer = [&](std::size_t input) {
    return RationalFunction(Polynomial(found.numerators[input]), Polynomial(found.denominator));
  };
  return {transfer(0), transfer(1), transfer(2), transfer(3)};
}

}  // namespace gearlash::drive
