// How pieces of a production run are drawn, and how sure what is found from them is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/fault.hpp"

namespace gearlash {

/// A number found from a sample.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  /// Of the value: the standard deviation over the replicates, divided by √replicates; NaN where
  /// fewer than two of them give a value.
  double standard_error = std::numeric_limits<double>::quiet_NaN();
};

/// Quasi-random points: the first `points` of Sobol's sequence (Gray-code order, direction numbers
/// of Joe and Kuo, SIAM J. Sci. Comput. 30, 2008), several times over, each time shifted digit by
/// digit (exclusive or) with random bits, independently from replicate to replicate, so that each
/// replicate is without bias and their scatter tells the error (Owen; L'Ecuyer and Lemieux, 2002).
struct SamplePlan {
  std::size_t points = 4096;    ///< of a replicate, ≥ 1; even over the cube at powers of two
  std::size_t replicates = 16;  ///< ≥ 2
  std::uint64_t seed = 1960;    ///< of the shifts; the same seed, the same bits on every machine

  std::size_t samples() const { return points * replicates; }
  bool operator==(const SamplePlan&) const = default;
};

inline constexpr std::size_t most_samples = 1'000'000'000;

/// The least sampling with at least so many samples whose points are a power of two.
SamplePlan sampling_of(std::size_t samples, const SamplePlan& like = {});

/// Every fault of the ranges above, and of more than most_samples.
std::vector<Fault> validate(const SamplePlan& sampling);

}  // namespace gearlash
