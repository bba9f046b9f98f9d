#include "vector_functions_lanes.hpp"

namespace gearlash::benchmarks {

#ifdef GEARLASH_X86_VECTOR_UNITS
using BaselineUnit = xsimd::sse2;  // as in cycle_kernel_baseline.cpp
#else
using BaselineUnit = xsimd::default_arch;
#endif

ByOperation<ColumnFunction> column_functions_baseline() {
  return column_functions_of<BaselineUnit>();
}

}  // namespace gearlash::benchmarks
