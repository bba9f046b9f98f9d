#include "question/map/basins.hpp"

#include <algorithm>
#include <array>

#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"
#include "gearlash/grid.hpp"
#include "general/attractors/search_setting.hpp"

namespace gearlash {
namespace {

constexpr std::array basin_kinds = {BasinKind::rest, BasinKind::hunting, BasinKind::running_away,
                                    BasinKind::not_known};

class Plane {
 public:
  Plane(const drive::ReducedDrive& drive, const drive::AttractorSearch& known,
        const StartPlane& plane, Basins& basins)
      : drive_(drive),
        known_(known),
        plane_(plane),
        basins_(basins),
        is_mirrored_(drive::is_own_image(drive)) {}

  void watch_points(SharedProgress& progress) {
    const std::size_t columns = basins_.positions.values.size();
    const std::size_t rows = basins_.speeds.values.size();
    basins_.kinds.assign(columns * rows, BasinKind::not_known);
    const std::size_t first = is_mirrored_ ? rows / 2 : 0;
    // A row's later starts join what its first ones led to.
    on_threads(0, rows - first, [&](std::size_t i) {
      const std::size_t row = first + i;
      const std::vector<BasinKind> found = kinds_of(
          of_each(basins_.positions.values,
                  [&](double position) {
                    return start_on_face(drive_, plane_, position, basins_.speeds.values[row]);
                  }),
          progress);
      for (std::size_t column = 0; column < found.size(); ++column) {
        basins_.kinds[row * columns + column] = found[column];
        if (is_mirrored_) {
          basins_.kinds[(rows - 1 - row) * columns + columns - 1 - column] = found[column];
        }
      }
      progress.finish(1);
    });
  }

  /// Each border once: those around every kind but the most frequent one.
  void trace_borders(SharedProgress& progress) {
    const auto count = [&](BasinKind kind) {
      return std::count(basins_.kinds.begin(), basins_.kinds.end(), kind);
    };
    const BasinKind most = *std::max_element(basin_kinds.begin(), basin_kinds.end(), by(count));
    for (const BasinKind kind : basin_kinds) {
      if (kind == most || count(kind) == 0 || progress.is_stopped()) continue;
      const auto side_of = [&](BasinKind found) {
        return found == kind ? Side::inside : Side::outside;
      };
      const std::vector<Side> corners = of_each(basins_.kinds, side_of);
      const auto side_at = [&](const MapPoint& place) {
        return side_of(
            kinds_of({start_on_face(drive_, plane_, place.x, place.y)}, progress).front());
      };
      constexpr CurveAccuracy accuracy{.halvings = 5, .straightness = 0.01, .shortest_chord = 0.02};
      const std::vector<MapCurve> curves =
          boundary_of_region(basins_.positions, basins_.speeds, corners, side_at, accuracy);
      add_all(basins_.borders, curves);
    }
  }

 private:
  std::vector<BasinKind> kinds_of(std::vector<drive::ShaftStates> starts,
                                  SharedProgress& progress) const {
    std::vector<BasinKind> found(starts.size(), BasinKind::not_known);
    const drive::AttractorSearch search = drive::find_attractors(
        drive_, {.starts = std::move(starts), .nearby = &known_, .most_edges = 0}, progress);
    for (std::size_t i = 0; i < search.outcomes.size(); ++i) {
      found[i] = kind_of(search.outcomes[i].end);
    }
    return found;
  }

  const drive::ReducedDrive& drive_;
  const drive::AttractorSearch& known_;
  const StartPlane& plane_;
  Basins& basins_;
  bool is_mirrored_;
};

}  // namespace

BasinKind kind_of(drive::MotionEnd end) {
  switch (end) {
    case drive::MotionEnd::rest:
      return BasinKind::rest;
    case drive::MotionEnd::cycle:
    case drive::MotionEnd::irregular:
      return BasinKind::hunting;
    case drive::MotionEnd::diverges:
      return BasinKind::running_away;
    case drive::MotionEnd::undecided:
      break;
  }
  return BasinKind::not_known;
}

bool Basins::has(BasinKind kind) const { return contains(kinds, kind); }

drive::ShaftStates start_on_face(const drive::ReducedDrive& drive, const StartPlane& plane,
                                 double position, double speed) {
  const bool is_pressed_back = position > 0.0 || (position == 0.0 && speed > 0.0);
  const double gap = (is_pressed_back ? -0.5 : 0.5) * drive.backlash;
  const double load =
      drive::value_at(drive.reference, 0.0) + position - (plane.is_of_motor ? gap : 0.0);
  return {.motor_position = load + gap,
          .motor_speed = speed,
          .load_position = load,
          .load_speed = speed};
}

Basins basins_of(const drive::ReducedDrive& drive, const drive::AttractorSearch& known,
                 const StartPlane& plane, Progress& progress) {
  Basins basins{.positions = linear("position", -plane.position, plane.position, plane.columns),
                .speeds = linear("speed", -plane.speed, plane.speed, plane.rows)};
  SharedProgress shared(progress, plane.rows);
  Plane work(drive, known, plane, basins);
  work.watch_points(shared);
  if (!shared.is_stopped()) work.trace_borders(shared);
  basins.is_complete = !shared.is_stopped();
  return basins;
}

}  // namespace gearlash
