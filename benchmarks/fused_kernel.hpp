// The batch kernel for AVX2 with multiplications and additions fused, as it is not built in the
// library: its bits are its own. To see what they would buy.
#pragma once

#include <cstddef>

#include "closed_form/lanes/cycle_kernel.hpp"

namespace gearlash::benchmarks {

bool has_fused_kernel();
/// Precondition: has_fused_kernel().
void solve_block_fused_avx2(detail::CycleBlock& block, std::size_t rows);

}  // namespace gearlash::benchmarks
