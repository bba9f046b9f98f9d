// A kernel's numbers: a vector of doubles, one lane for each servo, by vector unit.
#pragma once

#include <xsimd/xsimd.hpp>

namespace gearlash::detail {

template <class Unit>
struct VectorOf {
  using Real = xsimd::batch<double, Unit>;
  using Mask = xsimd::batch_bool<double, Unit>;
};

template <class Unit>
using Lanes = typename VectorOf<Unit>::Real;
template <class Unit>
using Mask = typename VectorOf<Unit>::Mask;

}  // namespace gearlash::detail
