#include "operations.hpp"

namespace gearlash::benchmarks {

const char* name_of(Operation operation) {
  constexpr ByOperation<const char*> names = {"exp",
                                              "log",
                                              "log1p",
                                              "atan2",
                                              "series of one decay, φ₂",
                                              "series of two decays, φ₃",
                                              "series of cosine or sine",
                                              "division",
                                              "square root",
                                              "multiplication",
                                              "addition",
                                              "comparison, selection, sign"};
  return names[static_cast<std::size_t>(operation)];
}

}  // namespace gearlash::benchmarks
