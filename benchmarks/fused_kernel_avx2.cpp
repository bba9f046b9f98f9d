#include "closed_form/lanes/cycle_kernel_lanes.hpp"
#include "fused_kernel.hpp"

namespace gearlash::benchmarks {

GEARLASH_INLINED_WHOLE void solve_block_fused_avx2(detail::CycleBlock& block, std::size_t rows) {
  detail::solve_block<detail::Twin<xsimd::fma3<xsimd::avx2>>>(block, rows);
}

}  // namespace gearlash::benchmarks
