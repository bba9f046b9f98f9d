// Regions of a map: where drives have one kind of motion, or meet a target.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gearlash/design.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

/// What is said of a place: verdicts, as far as a region is named by them, or whether it meets a
/// target. Without a valid drive it is not known.
enum class PlaceKind : std::uint8_t {
  not_known,
  rests,
  hunts_if_disturbed,
  hunts,
  runs_away,
  met,
  missed
};

PlaceKind kind_of(Verdict verdict);
PlaceKind kind_of(const Target& target, const Answer& answer);
/// "comes to rest", "hunts if disturbed", "hunts", "runs away", "met", "missed", "not known".
std::string_view name_of(PlaceKind kind);

/// What must be asked of a family's rows for their kinds: of motion, or by a target. Answers are
/// judged into `kinds`, one for each row; both must outlive the question.
AskedOfRows asked_for_kinds(const std::optional<Target>& target, std::span<PlaceKind> kinds);

struct MapRegion {
  PlaceKind kind{};
  /// Closed curves with the region on their left, partly along the map's edges.
  std::vector<MapCurve> outlines{};
};

/// Whether a map has regions: its axes have two finite numbers or more.
bool has_regions(const Grid& grid);

/// The regions of a map, by kind. `points`: the kinds of the grid's points, as asked_for_kinds()
/// gives them. Borders are located by fresh answers, once for both sides. In closed form with
/// plastic contact they are found as by boundary_of_region(), to 2⁻²⁴ of the axes. If faces bounce
/// or drives are searched, a border is located where it crosses the lines of the grid, to 1/400 of
/// the axes; within a cell it is straight. Stopped by `progress`, it is straight too, and lies
/// half-way between points. What differs from both of two neighbouring points, between them,
/// belongs to no region. Precondition: has_regions(); the axes are y, x.
std::vector<MapRegion> regions_of(const Grid& grid, std::span<const PlaceKind> points,
                                  const std::optional<Target>& target,
                                  Progress& progress = no_progress());

/// The outlines without the parts along the map's edges, each border once.
std::vector<MapCurve> borders_of(const std::vector<MapRegion>& regions, const Grid& grid);

}  // namespace gearlash
