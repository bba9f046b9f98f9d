#include "vector_functions_lanes.hpp"

namespace gearlash::benchmarks {

ByOperation<ColumnFunction> column_functions_avx2() { return column_functions_of<xsimd::avx2>(); }

}  // namespace gearlash::benchmarks
