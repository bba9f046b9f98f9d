// What the data of a grid say of the grid itself: axes, fixed numbers, origin.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gearlash/grid.hpp"
#include "output/netcdf_file.hpp"
#include "output/report_units.hpp"
#include "question/map/map_regions.hpp"

namespace gearlash {

/// The description that a grid's file holds.
struct GridContents {
  Grid grid;
  std::vector<Quantity> quantities;  ///< besides the verdict
  Provenance provenance;
  std::string source_text = {};  ///< of the sweep file; empty without one
};

/// Names and texts, the same for equal contents.
std::vector<std::pair<std::string, std::string>> attributes_of_file(const GridContents& contents);

/// "cannot hunt" is "cannot_hunt", as the words of flags must be.
std::string one_word(std::string_view words);
/// "cannot_hunt", "hunts", … in the order of the enumeration.
std::vector<std::string> verdict_words();

/// A parameter as the data of a grid show it.
struct NamedParameter {
  std::string name;  ///< of its column
  std::string path;
  std::string meaning;
  std::string unit;   ///< as UDUNITS spells it
  std::string words;  ///< of a choice, in the order of their numbers: "load motor"; else empty
};

NamedParameter named_parameter(const Axis& axis, const Drive& drive);
/// "linear", "logarithmic".
std::string spacing_of(const Axis& axis);

/// A number of the drive that is not on an axis, in SI.
struct FixedNumber {
  NamedParameter parameter;
  double value;
};

std::vector<FixedNumber> fixed_numbers(const Grid& grid);

/// The names of variables; those of quantities and axes are their own.
inline constexpr char verdict_name[] = "verdict";
inline constexpr char target_name[] = "target";
std::string boundary_name(const Axis& axis);

/// What a file has besides the answers of every grid.
struct GridExtras {
  bool has_target = false;          ///< whether each point meets a target
  std::size_t boundary_points = 0;  ///< of a map, gaps included; 0: no boundary
};
/// Dimensions, attributes and variables, those of the extras last.
NetcdfDescription description_of(const GridContents& contents, const GridExtras& extras);

/// How flags store whether a point meets a target.
std::vector<std::byte> target_flags(std::span<const PlaceKind> kinds);

}  // namespace gearlash
