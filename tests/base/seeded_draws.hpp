// Random numbers that are the same on every machine: the distributions of <random> are not. (Draw
// once an expression or within braces: the order of arguments and operands is the compiler's.)
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace gearlash {

class SeededDraws {
 public:
  explicit SeededDraws(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool happens(double probability) { return uniform(0.0, 1.0) < probability; }
  double one_of(std::initializer_list<double> values) {
    return values.begin()[static_cast<std::size_t>(engine_() % values.size())];
  }
  /// Of either sign, log-uniform in size.
  double either_sign(double low, double high) {
    const double side = sign();
    return side * log_uniform(low, high);
  }
  double sign() { return happens(0.5) ? 1.0 : -1.0; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace gearlash
