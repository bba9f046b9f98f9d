// The numbers that a kernel works on: a vector of doubles, a lane a servo; by the vector unit's
// name.
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
