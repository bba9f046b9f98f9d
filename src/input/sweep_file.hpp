// The sweep that a TOML file describes: a drive, and what is varied of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/grid.hpp"

namespace gearlash {

struct SweepFile {
  Grid grid;                         ///< sound: faults(grid) is empty
  std::vector<Quantity> quantities;  ///< all that are known where the file names none
  std::string text;                  ///< of the file
};

/// Parameters are varied in so many directions at most.
inline constexpr std::size_t most_axes_of_a_sweep = 6;
inline constexpr std::size_t largest_sweep_file = 1024 * 1024;  ///< bytes

/// Reads TOML text: the section [sweep] with `axes`, a list of axes as read_axis() has them, the
/// last varying fastest, `quantities`, a list of names, and `verdicts`,
/// "computed" or "proved"; and the sections of a drive's file, which leave out what is varied, and
/// [servo] the backlash where amplitudes are to be in backlashes (docs/command-line.md). Tables of
/// signals are in `folder`. Throws InvalidInput with every fault, as parse_drive() does.
SweepFile parse_sweep(std::string_view toml, std::string_view source_name,
                      const std::filesystem::path& folder = {});

/// parse_sweep of what the file holds.
SweepFile read_sweep_file(const std::filesystem::path& path);

}  // namespace gearlash
