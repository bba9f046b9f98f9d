#include "vector_functions_lanes.hpp"

namespace gearlash::benchmarks {

ByOperation<ColumnFunction> column_functions_avx512() {
  return column_functions_of<xsimd::avx512bw>();
}

}  // namespace gearlash::benchmarks
