#include "servo_lists.hpp"

#include <cmath>
#include <cstdint>
#include <random>

namespace gearlash::benchmarks {

Grid thesis_grid() {
  return {.drive = normal_form(0.1, 1.0, 0.5, 0.3),
          .axes = {spaced_axis("damping", "servo.damping", 0.05, 0.5, 40, Spacing::linear),
                   spaced_axis("inertia_ratio", "servo.inertia_ratio", 1.0 / 9.0, 9.0, 50,
                               Spacing::logarithmic),
                   spaced_axis("friction_ratio", "servo.friction_ratio", 0.04, 0.6, 50,
                               Spacing::linear)}};
}

std::vector<NormalizedServo> servos_of(const Grid& grid) {
  std::vector<NormalizedServo> servos;
  const Family family(grid);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    servos.push_back(family.normal_form_at(values_at(grid, i)));
  }
  return servos;
}

Table table_of(std::size_t rows) { return Table(rows, solved_quantities); }

std::vector<NormalizedServo> wide_draw() {
  constexpr std::uint64_t seed = 1960;
  constexpr std::size_t count = 100'000;
  std::mt19937_64 engine(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  const auto log_uniform = [&](double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  };
  std::vector<NormalizedServo> servos;
  for (std::size_t i = 0; i < count; ++i) {
    servos.push_back({.damping = log_uniform(1e-3, 0.95),
                      .inertia_ratio = log_uniform(1e-3, 1e3),
                      .friction_ratio = uniform(0.001, 0.999),
                      .backlash = 0.3});
  }
  return servos;
}

}  // namespace gearlash::benchmarks
