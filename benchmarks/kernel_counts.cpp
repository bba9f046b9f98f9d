#include "kernel_counts.hpp"

#include <stdexcept>

#include "counting_lanes.hpp"

// A series is counted as one, whatever its terms.
#define GEARLASH_COUNT_SERIES(lanes)                                                             \
  template <>                                                                                    \
  benchmarks::CountingLanes<lanes> single_rate_series_lanes<benchmarks::CountingUnit<lanes>>(    \
      const benchmarks::CountingLanes<lanes>& x) {                                               \
    return x.map(benchmarks::Operation::decay_series, single_rate_series);                       \
  }                                                                                              \
  template <>                                                                                    \
  benchmarks::CountingLanes<lanes> two_rate_series_lanes<benchmarks::CountingUnit<lanes>>(       \
      const benchmarks::CountingLanes<lanes>& x, const benchmarks::CountingLanes<lanes>& y) {    \
    return x.map(benchmarks::Operation::two_decay_series, two_rate_series, y);                   \
  }                                                                                              \
  template <>                                                                                    \
  benchmarks::CountingLanes<lanes> alternating_series_lanes<benchmarks::CountingUnit<lanes>, 0>( \
      const benchmarks::CountingLanes<lanes>& square) {                                          \
    return square.map(benchmarks::Operation::circular_series,                                    \
                      [](double x) { return std::cos(std::sqrt(x)); });                          \
  }                                                                                              \
  template <>                                                                                    \
  benchmarks::CountingLanes<lanes> alternating_series_lanes<benchmarks::CountingUnit<lanes>, 1>( \
      const benchmarks::CountingLanes<lanes>& square) {                                          \
    return square.map(benchmarks::Operation::circular_series, [](double x) {                     \
      return x > 0.0 ? std::sin(std::sqrt(x)) / std::sqrt(x) : 1.0;                              \
    });                                                                                          \
  }

namespace gearlash::detail {

GEARLASH_COUNT_SERIES(1)
GEARLASH_COUNT_SERIES(4)
GEARLASH_COUNT_SERIES(8)
GEARLASH_COUNT_SERIES(16)

}  // namespace gearlash::detail

#undef GEARLASH_COUNT_SERIES

namespace gearlash::benchmarks {
namespace {

using detail::CycleBlock;

template <std::size_t lanes>
ByOperation<double> counted(std::span<const NormalizedServo> servos) {
  counted_operations = {};
  CycleBlock block;
  const std::size_t whole_blocks = servos.size() / CycleBlock::rows;
  for (std::size_t begin = 0; begin < whole_blocks * CycleBlock::rows; begin += CycleBlock::rows) {
    for (std::size_t row = 0; row < CycleBlock::rows; ++row) {
      const NormalizedServo& servo = servos[begin + row];
      block.damping[row] = servo.damping;
      block.inertia_ratio[row] = servo.inertia_ratio;
      block.friction_ratio[row] = servo.friction_ratio;
      block.backlash[row] = servo.backlash;
    }
    detail::solve_block<CountingUnit<lanes>>(block, CycleBlock::rows);
  }
  ByOperation<double> means;
  for (std::size_t i = 0; i < operation_count; ++i) {
    means[i] = static_cast<double>(counted_operations[i]) /
               static_cast<double>(whole_blocks * CycleBlock::rows);
  }
  return means;
}

}  // namespace

ByOperation<double> operations_of_kernel(std::span<const NormalizedServo> servos,
                                         std::size_t lanes) {
  switch (lanes) {
    case 1:
      return counted<1>(servos);
    case 4:
      return counted<4>(servos);
    case 8:
      return counted<8>(servos);
    case 16:
      return counted<16>(servos);
    default:
      throw std::invalid_argument("operations_of_kernel() counts 1, 4, 8 or 16 lanes");
  }
}

}  // namespace gearlash::benchmarks
