#include "question/map/map_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "base/lists.hpp"
#include "base/names.hpp"
#include "base/progress_part.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "question/change/target.hpp"

namespace gearlash {
namespace {

constexpr std::array region_order = {
    PlaceKind::met,   PlaceKind::missed,    PlaceKind::rests,    PlaceKind::hunts_if_disturbed,
    PlaceKind::hunts, PlaceKind::runs_away, PlaceKind::not_known};
constexpr double longest_in_cells = 2.0;  ///< shares of the axes: no chord is divided

/// The kinds of places by fresh answers, each judged once although two regions ask. For several
/// threads.
class PlaceJudge {
 public:
  PlaceJudge(const Family& family, const std::optional<Target>& target, SerialProgress& progress)
      : family_(family), target_(target), progress_(progress) {}

  PlaceKind kind_at(const MapPoint& place) {
    {
      const std::scoped_lock lock(using_);
      const auto known = known_.find({place.x, place.y});
      if (known != known_.end()) return known->second;
    }
    PlaceKind kind{};
    AskedOfRows asked = asked_for_kinds(target_, {&kind, 1});
    asked.one_by_one = asked.whole;
    const std::array values = {place.y, place.x};
    ProgressPart part(progress_, not_a_number, not_a_number);
    evaluate(family_, rows_of(std::span<const double>(values), values.size()), asked, part);
    const std::scoped_lock lock(using_);
    return known_[{place.x, place.y}] = kind;
  }

 private:
  const Family& family_;
  const std::optional<Target>& target_;
  SerialProgress& progress_;
  std::mutex using_;
  std::map<std::pair<double, double>, PlaceKind> known_;
};

/// The axis with a value on either side of it.
Axis widened(const Axis& axis) {
  constexpr double share = 0.01;
  const double low = axis.values.front();
  const double high = axis.values.back();
  Axis wide = axis;
  const double ratio = std::pow(high / low, share);
  const double aside = share * (high - low);
  wide.values.insert(wide.values.begin(), axis.logarithmic ? low / ratio : low - aside);
  wide.values.push_back(axis.logarithmic ? high * ratio : high + aside);
  return wide;
}

bool contains(const Axis& axis, double value) {
  return value >= axis.values.front() && value <= axis.values.back();
}

/// The sides of the points of the widened axes: all beyond the map are outside.
std::vector<Side> widened_sides(std::span<const PlaceKind> points, std::size_t width,
                                PlaceKind kind) {
  std::vector<Side> sides((points.size() / width + 2) * (width + 2), Side::outside);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] == kind) sides[(i / width + 1) * (width + 2) + i % width + 1] = Side::inside;
  }
  return sides;
}

std::vector<MapRegion> outlined(const Grid& grid, std::span<const PlaceKind> points,
                                PlaceJudge& judge, const CurveAccuracy& accuracy,
                                Progress& progress) {
  const Axis& x = grid.axes[1];
  const Axis& y = grid.axes[0];
  const Axis wide_x = widened(x);
  const Axis wide_y = widened(y);
  std::vector<MapRegion> regions;
  for (std::size_t i = 0; i < region_order.size(); ++i) {
    const PlaceKind kind = region_order[i];
    if (!contains(points, kind)) continue;
    const auto side_at = [&](const MapPoint& place) {
      const bool is_on_map = contains(x, place.x) && contains(y, place.y);
      return is_on_map && judge.kind_at(place) == kind ? Side::inside : Side::outside;
    };
    const std::vector<Side> sides = widened_sides(points, x.values.size(), kind);
    ProgressPart part(progress, i, region_order.size());
    MapRegion region{kind, boundary_of_region(wide_x, wide_y, sides, side_at, accuracy, part)};
    for (MapCurve& outline : region.outlines) {
      for (MapPoint& point : outline) {
        point.x = std::clamp(point.x, x.values.front(), x.values.back());
        point.y = std::clamp(point.y, y.values.front(), y.values.back());
      }
    }
    regions.push_back(std::move(region));
  }
  return regions;
}

/// With plastic contact that of pictures. Searches are few: to 1/400 of the axes on the grid's
/// lines.
CurveAccuracy accuracy_of(const Grid& grid, const EnginesNeeded& engines) {
  CurveAccuracy accuracy = picture_accuracy;
  accuracy.is_midway = true;
  if (!engines.search && !engines.bounces) return accuracy;
  constexpr double located = 1.0 / 400.0;
  double widest = located;
  for (const Axis& axis : grid.axes) {
    for (std::size_t i = 0; i + 1 < axis.values.size(); ++i) {
      widest = std::max(widest,
                        position_on(axis, axis.values[i + 1]) - position_on(axis, axis.values[i]));
    }
  }
  accuracy.halvings = static_cast<int>(std::ceil(std::log2(widest / located)));
  accuracy.shortest_chord = longest_in_cells;
  return accuracy;
}

}  // namespace

PlaceKind kind_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::cannot_hunt:
    case Verdict::comes_to_rest:
      return PlaceKind::rests;
    case Verdict::hunts_if_disturbed:
      return PlaceKind::hunts_if_disturbed;
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
    case Verdict::forced:
    case Verdict::undamped:
      return PlaceKind::hunts;
    case Verdict::grows_without_bound:
    case Verdict::runs_away:
    case Verdict::runs_away_if_disturbed:
      return PlaceKind::runs_away;
    case Verdict::undecided:
      break;
  }
  return PlaceKind::not_known;
}

std::string_view name_of(PlaceKind kind) {
  constexpr Names<PlaceKind::missed> names("not known", "comes to rest", "hunts if disturbed",
                                           "hunts", "runs away", "met", "missed");
  return names[kind];
}

PlaceKind kind_of(const Target& target, const Answer& answer) {
  if (!is_known(target, answer)) return PlaceKind::not_known;
  return is_met(target, answer) ? PlaceKind::met : PlaceKind::missed;
}

AskedOfRows asked_for_kinds(const std::optional<Target>& target, std::span<PlaceKind> kinds) {
  AskedOfRows asked{.take = [&target, kinds](std::size_t row, const Answer* answer) {
    if (answer == nullptr) return;
    kinds[row] = target ? kind_of(*target, *answer) : kind_of(answer->verdict);
  }};
  if (!target) return asked;
  asked.wanted = wanted_for(*target);
  asked.whole = !is_of_boxes(*target);
  return asked;
}

bool has_regions(const Grid& grid) {
  return all_of(grid.axes, [&](const Axis& axis) {
    return axis.values.size() > 1 && std::isfinite(axis.values.back()) &&
           parameter_of(axis, grid.drive)->choices.empty();
  });
}

std::vector<MapRegion> regions_of(const Grid& grid, std::span<const PlaceKind> points,
                                  const std::optional<Target>& target, Progress& progress) {
  const Family family(grid);
  SerialProgress heard(progress);
  PlaceJudge judge(family, target, heard);
  std::vector<MapRegion> regions =
      outlined(grid, points, judge, accuracy_of(grid, family.engines()), heard);
  if (heard.go_on(1.0)) return regions;
  return outlined(grid, points, judge,
                  {.halvings = 0, .shortest_chord = longest_in_cells, .is_midway = true},
                  no_progress());
}

std::vector<MapCurve> borders_of(const std::vector<MapRegion>& regions, const Grid& grid) {
  constexpr double rounding = 1e-9;
  const auto is_at_edge = [&](std::size_t axis, double one, double other) {
    const double at = position_on(grid.axes[axis], one);
    const double there = position_on(grid.axes[axis], other);
    return std::max(at, there) < rounding || std::min(at, there) > 1.0 - rounding;
  };
  const auto is_edge = [&](const MapPoint& from, const MapPoint& to) {
    return is_at_edge(1, from.x, to.x) || is_at_edge(0, from.y, to.y);
  };
  std::vector<MapCurve> borders;
  const auto add = [&](MapCurve outline) {
    // A ring begins along an edge, if it has one, so that no border is cut in two.
    const auto edge = std::adjacent_find(outline.begin(), outline.end(), is_edge);
    if (edge != outline.end()) {
      outline.pop_back();
      std::rotate(outline.begin(), edge, outline.end());
      outline.push_back(outline.front());
    }
    MapCurve border;
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      if (!is_edge(outline[i], outline[i + 1])) {
        if (border.empty()) border.push_back(outline[i]);
        border.push_back(outline[i + 1]);
      }
      const bool ends = i + 2 == outline.size() || is_edge(outline[i], outline[i + 1]);
      if (ends && !border.empty()) borders.push_back(std::exchange(border, {}));
    }
  };
  // Each border has two sides: the last region's is that of the others.
  for (std::size_t i = 0; i + 1 < regions.size(); ++i) {
    for (const MapCurve& outline : regions[i].outlines) add(outline);
  }
  return borders;
}

}  // namespace gearlash
