// Two vectors processed together.
//
// Dependent operations within each are a long chain, in which the processor mostly waits. Two
// chains wait at the same time.
#pragma once

#include <cstddef>

#include "closed_form/lanes/lanes.hpp"

namespace gearlash::detail {

/// A vector unit with twice the lanes.
template <class Unit>
struct Twin {};

template <class Unit>
struct TwinMask {
  using Half = Mask<Unit>;
  Half low;
  Half high;

  friend TwinMask operator&&(const TwinMask& a, const TwinMask& b) {
    return {a.low && b.low, a.high && b.high};
  }
  friend TwinMask operator||(const TwinMask& a, const TwinMask& b) {
    return {a.low || b.low, a.high || b.high};
  }
  friend TwinMask operator!(const TwinMask& a) { return {!a.low, !a.high}; }
  friend bool any(const TwinMask& a) { return any(a.low || a.high); }
  friend bool all(const TwinMask& a) { return all(a.low && a.high); }
};

template <class Unit>
struct TwinLanes {
  using Half = Lanes<Unit>;
  static constexpr std::size_t size = 2 * Half::size;
  Half low;
  Half high;

  TwinLanes() = default;
  TwinLanes(double value) : low(value), high(value) {}
  TwinLanes(const Half& first, const Half& second) : low(first), high(second) {}
  static TwinLanes load_aligned(const double* from) {
    return {Half::load_aligned(from), Half::load_aligned(from + Half::size)};
  }
  void store_aligned(double* to) const {
    low.store_aligned(to);
    high.store_aligned(to + Half::size);
  }

  friend TwinLanes operator-(const TwinLanes& a) { return {-a.low, -a.high}; }
  friend TwinLanes operator+(const TwinLanes& a, const TwinLanes& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend TwinLanes operator-(const TwinLanes& a, const TwinLanes& b) {
    return {a.low - b.low, a.high - b.high};
  }
  friend TwinLanes operator*(const TwinLanes& a, const TwinLanes& b) {
    return {a.low * b.low, a.high * b.high};
  }
  friend TwinLanes operator/(const TwinLanes& a, const TwinLanes& b) {
    return {a.low / b.low, a.high / b.high};
  }
  friend TwinMask<Unit> operator<(const TwinLanes& a, const TwinLanes& b) {
    return {a.low < b.low, a.high < b.high};
  }
  friend TwinMask<Unit> operator>(const TwinLanes& a, const TwinLanes& b) {
    return {a.low > b.low, a.high > b.high};
  }
  friend TwinMask<Unit> operator<=(const TwinLanes& a, const TwinLanes& b) {
    return {a.low <= b.low, a.high <= b.high};
  }
  friend TwinMask<Unit> operator>=(const TwinLanes& a, const TwinLanes& b) {
    return {a.low >= b.low, a.high >= b.high};
  }
  friend TwinMask<Unit> isnan(const TwinLanes& a) { return {isnan(a.low), isnan(a.high)}; }

  friend TwinLanes abs(const TwinLanes& a) { return {abs(a.low), abs(a.high)}; }
  friend TwinLanes sqrt(const TwinLanes& a) { return {sqrt(a.low), sqrt(a.high)}; }
  friend TwinLanes exp(const TwinLanes& a) { return {exp(a.low), exp(a.high)}; }
  friend TwinLanes log(const TwinLanes& a) { return {log(a.low), log(a.high)}; }
  friend TwinLanes log1p(const TwinLanes& a) { return {log1p(a.low), log1p(a.high)}; }
  friend TwinLanes atan2(const TwinLanes& a, const TwinLanes& b) {
    return {atan2(a.low, b.low), atan2(a.high, b.high)};
  }
  friend TwinLanes min(const TwinLanes& a, const TwinLanes& b) {
    return {min(a.low, b.low), min(a.high, b.high)};
  }
  friend TwinLanes max(const TwinLanes& a, const TwinLanes& b) {
    return {max(a.low, b.low), max(a.high, b.high)};
  }
  friend TwinLanes copysign(const TwinLanes& a, const TwinLanes& b) {
    return {copysign(a.low, b.low), copysign(a.high, b.high)};
  }
  friend TwinLanes select(const TwinMask<Unit>& mask, const TwinLanes& a, const TwinLanes& b) {
    return {select(mask.low, a.low, b.low), select(mask.high, a.high, b.high)};
  }
};

template <class Unit>
struct VectorOf<Twin<Unit>> {
  using Real = TwinLanes<Unit>;
  using Mask = TwinMask<Unit>;
};

}  // namespace gearlash::detail
