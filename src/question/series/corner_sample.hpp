// Which corners of a box of many parameters are tried first.
#pragma once

#include <cstddef>
#include <vector>

namespace gearlash {

/// For each corner, whether each parameter is at its upper end. Of up to four parameters all
/// corners; of more a fraction of 16, in which any three of up to eight take all combinations of
/// their ends (2^(8−4) of resolution IV: Box and Hunter, Technometrics 3, 1961). Of more than eight
/// those eight apart take the same ends. `parameters` ≥ 1.
std::vector<std::vector<bool>> corner_sample(std::size_t parameters);

}  // namespace gearlash
