#include "closed_form/lanes/cycle_kernel_lanes.hpp"

namespace gearlash::detail {

// Named, because xsimd's default, and so which operations are fused, follows the compiler flags.
GEARLASH_INLINED_WHOLE void solve_block_avx2(CycleBlock& block, std::size_t rows) {
  solve_block<Twin<xsimd::avx2>>(block, rows);
}

}  // namespace gearlash::detail
