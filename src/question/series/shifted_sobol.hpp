// Sobol's points, randomly shifted, from any index on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gearlash/tolerance.hpp"

namespace gearlash::detail {

class ShiftedSobol {
 public:
  ShiftedSobol(std::size_t dimensions, const SamplePlan& sampling);

  /// Writes the points from `first` on of a replicate, one after another, until `coordinates` is
  /// full. Each coordinate is (k + ½)/2⁵², k from 0 to 2⁵² − 1, so it lies strictly between
  /// 0 and 1.
  void fill(std::size_t replicate, std::size_t first, std::span<double> coordinates) const;

 private:
  std::size_t dimensions_;
  struct Sequence;                            // Boost's
  std::shared_ptr<const Sequence> sequence_;  ///< at its start; users copy it and seek
  std::vector<std::uint64_t> shifts_;         ///< by replicate and dimension
};

}  // namespace gearlash::detail
