// Bisection between two places on different sides of a region's boundary.
#pragma once

#include "question/map/region_boundary.hpp"

namespace gearlash {

struct SideChange {
  double place = 0.0;           ///< the last place inside
  double outside = 0.0;         ///< the first place beyond it
  Side beyond = Side::outside;  ///< the side beyond it
};

/// Bisects `halvings` times, or until neighboring numbers are reached. Whatever lies between, the
/// side changes at the place found.
template <class SideAt>
SideChange bisect_sides(const SideAt& side_at, double inside, double outside, int halvings) {
  Side beyond = Side::outside;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    if (middle == inside || middle == outside) break;
    const Side side = side_at(middle);
    if (side != Side::inside) beyond = side;
    (side == Side::inside ? inside : outside) = middle;
  }
  return {inside, outside, beyond};
}

}  // namespace gearlash
