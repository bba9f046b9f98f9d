// The sweep that a TOML file describes: a drive and its varied parameters.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/grid.hpp"

namespace gearlash {

struct SweepFile {
  Grid grid;                         ///< valid: faults(grid) is empty
  std::vector<Quantity> quantities;  ///< all known ones if the file names none
  std::string text;                  ///< of the file
  std::vector<std::string>
      left_out{};  ///< a line for each axis of which read_axis() left values out
};

/// The largest number of axes.
inline constexpr std::size_t most_axes_of_a_sweep = 6;
inline constexpr std::size_t largest_sweep_file = 1024 * 1024;  ///< bytes

/// Reads TOML text. The section [sweep] has `axes`, a list of axes as read_axis() reads them, the
/// last varying fastest; `quantities`, a list of names; and `verdicts`, "computed" or "proved". The
/// other sections are those of a drive file without the varied parameters; [servo] without backlash
/// gives amplitudes in backlashes (docs/reference/command-line.md). Signal tables are read from
/// `folder`. Throws InvalidInput with every fault, as parse_drive() does.
SweepFile parse_sweep(std::string_view toml, std::string_view source_name,
                      const std::filesystem::path& folder = {});

/// parse_sweep() of a file's contents.
SweepFile read_sweep_file(const std::filesystem::path& path);

}  // namespace gearlash
