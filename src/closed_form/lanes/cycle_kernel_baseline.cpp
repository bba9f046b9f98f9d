#include <xsimd/xsimd.hpp>

#include "closed_form/lanes/cycle_kernel.hpp"
#ifndef XSIMD_NO_SUPPORTED_ARCHITECTURE
#include "closed_form/lanes/cycle_kernel_lanes.hpp"
#endif

namespace gearlash::detail {

GEARLASH_INLINED_WHOLE void solve_block_baseline(CycleBlock& block, std::size_t rows) {
#if defined(XSIMD_NO_SUPPORTED_ARCHITECTURE)
  for (std::size_t row = 0; row < rows; ++row) block.outcome[row] = CycleBlock::uncertain;
#elif defined(GEARLASH_X86_VECTOR_UNITS)
  // Named, because xsimd's default, and so which operations are fused, follows the compiler flags.
  solve_block<Twin<xsimd::sse2>>(block, rows);
#else
  solve_block<Twin<xsimd::default_arch>>(block, rows);
#endif
}

}  // namespace gearlash::detail
