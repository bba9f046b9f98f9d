// Lanes that count what is done to them, in place of a vector unit: the kernel, compiled for them,
// tells how many operations of each kind it needs. They compute as well, since how often the kernel
// iterates depends on the servo.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "closed_form/lanes/cycle_kernel_lanes.hpp"
#include "operations.hpp"

namespace gearlash::benchmarks {

/// Operations on lanes since the program began.
inline ByOperation<std::uint64_t> counted_operations{};

/// As a vector unit: one of so many lanes, which go in step as those of a real one do.
template <std::size_t lanes>
struct CountingUnit {};

template <std::size_t lanes>
struct CountingMask {
  std::array<bool, lanes> lane;

  friend CountingMask operator&&(const CountingMask& a, const CountingMask& b) {
    CountingMask result;
    for (std::size_t i = 0; i < lanes; ++i) result.lane[i] = a.lane[i] && b.lane[i];
    return result;
  }
  friend CountingMask operator!(const CountingMask& a) {
    CountingMask result;
    for (std::size_t i = 0; i < lanes; ++i) result.lane[i] = !a.lane[i];
    return result;
  }
  friend CountingMask operator||(const CountingMask& a, const CountingMask& b) {
    return !(!a && !b);
  }
  friend bool any(const CountingMask& a) {
    return std::any_of(a.lane.begin(), a.lane.end(), [](bool value) { return value; });
  }
  friend bool all(const CountingMask& a) { return !any(!a); }
};

template <std::size_t lanes>
class CountingLanes {
 public:
  static constexpr std::size_t size = lanes;
  using Truth = CountingMask<lanes>;

  CountingLanes() = default;
  CountingLanes(double value) { lane_.fill(value); }
  static CountingLanes load_aligned(const double* from) {
    CountingLanes result;
    std::copy_n(from, lanes, result.lane_.begin());
    return result;
  }
  void store_aligned(double* to) const { std::copy(lane_.begin(), lane_.end(), to); }

  /// operation(this lane, that lane, …) in every lane.
  template <class Function, class... Others>
  CountingLanes map(Operation operation, const Function& function, const Others&... others) const {
    counted_operations[static_cast<std::size_t>(operation)] += lanes;
    CountingLanes result;
    for (std::size_t i = 0; i < lanes; ++i) {
      result.lane_[i] = function(lane_[i], others.lane_[i]...);
    }
    return result;
  }

  friend CountingLanes operator-(const CountingLanes& a) {
    return a.map(Operation::choice, [](double x) { return -x; });
  }
  friend CountingLanes operator+(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::sum, [](double x, double y) { return x + y; }, b);
  }
  friend CountingLanes operator-(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::sum, [](double x, double y) { return x - y; }, b);
  }
  friend CountingLanes operator*(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::product, [](double x, double y) { return x * y; }, b);
  }
  friend CountingLanes operator/(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::division, [](double x, double y) { return x / y; }, b);
  }
  friend CountingLanes sqrt(const CountingLanes& a) {
    return a.map(Operation::root, [](double x) { return std::sqrt(x); });
  }
  friend CountingLanes exp(const CountingLanes& a) {
    return a.map(Operation::exponential, [](double x) { return std::exp(x); });
  }
  friend CountingLanes log(const CountingLanes& a) {
    return a.map(Operation::logarithm, [](double x) { return std::log(x); });
  }
  friend CountingLanes log1p(const CountingLanes& a) {
    return a.map(Operation::logarithm_of_one_plus, [](double x) { return std::log1p(x); });
  }
  friend CountingLanes atan2(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::arc_tangent, [](double y, double x) { return std::atan2(y, x); }, b);
  }
  friend CountingLanes abs(const CountingLanes& a) {
    return a.map(Operation::choice, [](double x) { return std::abs(x); });
  }
  friend CountingLanes copysign(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::choice, [](double x, double y) { return std::copysign(x, y); }, b);
  }
  friend CountingLanes min(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::choice, [](double x, double y) { return std::min(x, y); }, b);
  }
  friend CountingLanes max(const CountingLanes& a, const CountingLanes& b) {
    return a.map(
        Operation::choice, [](double x, double y) { return std::max(x, y); }, b);
  }
  friend CountingLanes select(const Truth& mask, const CountingLanes& a, const CountingLanes& b) {
    counted_operations[static_cast<std::size_t>(Operation::choice)] += lanes;
    CountingLanes result;
    for (std::size_t i = 0; i < lanes; ++i) {
      result.lane_[i] = mask.lane[i] ? a.lane_[i] : b.lane_[i];
    }
    return result;
  }

  friend Truth operator<(const CountingLanes& a, const CountingLanes& b) {
    return a.compare([](double x, double y) { return x < y; }, b);
  }
  friend Truth operator<=(const CountingLanes& a, const CountingLanes& b) {
    return a.compare([](double x, double y) { return x <= y; }, b);
  }
  friend Truth operator>(const CountingLanes& a, const CountingLanes& b) { return b < a; }
  friend Truth operator>=(const CountingLanes& a, const CountingLanes& b) { return b <= a; }
  friend Truth isnan(const CountingLanes& a) {
    return a.compare([](double x, double y) { return x != y; }, a);
  }

 private:
  template <class Comparison>
  Truth compare(const Comparison& comparison, const CountingLanes& other) const {
    counted_operations[static_cast<std::size_t>(Operation::choice)] += lanes;
    Truth result;
    for (std::size_t i = 0; i < lanes; ++i) {
      result.lane[i] = comparison(lane_[i], other.lane_[i]);
    }
    return result;
  }

  std::array<double, lanes> lane_;
};

}  // namespace gearlash::benchmarks

namespace gearlash::detail {

template <std::size_t lanes>
struct VectorOf<benchmarks::CountingUnit<lanes>> {
  using Real = benchmarks::CountingLanes<lanes>;
  using Mask = benchmarks::CountingMask<lanes>;
};

}  // namespace gearlash::detail
