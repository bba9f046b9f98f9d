// Long lists of servos, as a map or a design study asks for them.
#pragma once

#include <string>
#include <vector>

#include "question/family/evaluation.hpp"

namespace gearlash::benchmarks {

/// Damping 0.05 … 0.5, inertia ratio 1/9 … 9, friction ratio 0.04 … 0.6, backlash 0.3: a hundred
/// thousand servos over what the thesis's charts cover, hunting or not.
Grid thesis_grid();
std::vector<NormalizedServo> servos_of(const Grid& grid);

/// With a column for all that the closed form knows.
Table table_of(std::size_t rows);

/// As many, drawn at random from far wider ranges (damping 1e-3 … 0.95, inertia ratio 1e-3 … 1e3,
/// friction ratio 0.001 … 0.999), so that neighbours in the lanes have nothing in common.
std::vector<NormalizedServo> wide_draw();

}  // namespace gearlash::benchmarks
