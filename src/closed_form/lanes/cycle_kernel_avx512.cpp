#include "closed_form/lanes/cycle_kernel_lanes.hpp"

namespace gearlash::detail {

// Named, because xsimd's default follows the user's compiler flags, and with it what is fused.
GEARLASH_INLINED_WHOLE void solve_block_avx512(CycleBlock& block, std::size_t rows) {
  solve_block<Twin<xsimd::avx512bw>>(block, rows);
}

}  // namespace gearlash::detail
