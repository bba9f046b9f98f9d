// The sweep that a TOML file describes: a servo, and what is varied of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/grid/servo_grid.hpp"
#include "closed_form/lanes/cycle_table.hpp"

namespace gearlash {

struct SweepFile {
  ServoGrid grid;                         ///< sound: validate(grid) is empty
  std::vector<CycleQuantity> quantities;  ///< all where the file names none
  std::string text;                       ///< of the file
};

/// Inputs are varied in so many directions at most.
inline constexpr std::size_t most_axes_of_a_sweep = 6;
inline constexpr std::size_t largest_sweep_file = 1024 * 1024;  ///< bytes

/// Reads TOML text: the section [sweep] with `axes`, a list of axes as read_axis() has them, the
/// last varying fastest, `quantities`, a list of names, and `verdicts`,
/// "computed" or "proved"; and the sections of a servo file, in
/// which [servo] leaves out what is varied, and the backlash where sizes are to be in backlashes
/// (docs/command-line.md). Throws InvalidInput with every fault, as parse_servo() does.
SweepFile parse_sweep(std::string_view toml, std::string_view source_name);

/// parse_sweep of what the file holds.
SweepFile read_sweep_file(const std::filesystem::path& path);

}  // namespace gearlash
