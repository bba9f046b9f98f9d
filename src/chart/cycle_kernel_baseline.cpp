#include "cycle_kernel_lanes.hpp"

namespace gearlash::detail {

void solve_block_baseline(CycleBlock& block, std::size_t rows) {
  solve_block<xsimd::default_arch>(block, rows);
}

}  // namespace gearlash::detail
