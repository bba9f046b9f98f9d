#include "vector_functions.hpp"

namespace gearlash::benchmarks {

// Two vectors go together (src/closed_form/lanes/twin_lanes.hpp).
std::size_t lanes_in_step(VectorUnit unit) {
  switch (unit) {
    case VectorUnit::baseline:
      return 4;
    case VectorUnit::avx2:
      return 8;
    case VectorUnit::avx512:
      return 16;
  }
  return 1;
}

ByOperation<ColumnFunction> column_functions(VectorUnit unit) {
#ifdef GEARLASH_X86_VECTOR_UNITS
  if (unit == VectorUnit::avx512) return column_functions_avx512();
  if (unit == VectorUnit::avx2) return column_functions_avx2();
#endif
  static_cast<void>(unit);  // elsewhere there is but one
  return column_functions_baseline();
}

}  // namespace gearlash::benchmarks
