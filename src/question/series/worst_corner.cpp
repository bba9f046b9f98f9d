#include "question/series/worst_corner.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/lists.hpp"
#include "base/names.hpp"
#include "base/on_threads.hpp"
#include "base/range_check.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "question/series/shifted_sobol.hpp"

namespace gearlash {
namespace {

using Values = std::vector<double>;

/// The order of drives from good to bad: by amplitude, where any drive that hunts is worse than one
/// that does not, then by growth at rest.
struct Badness {
  double amplitude = -1.0;  ///< −1 where it does not hunt, −2 where unknown
  double growth = -1.0;     ///< of a drive that does not hunt

  bool operator<(const Badness& other) const {
    return amplitude != other.amplitude ? amplitude < other.amplitude : growth < other.growth;
  }
};

bool is_notably_worse(const Badness& a, const Badness& b) {
  constexpr double notable = 1e-12;
  const double size = b.amplitude > 0.0 ? b.amplitude * (1.0 + notable) : b.amplitude;
  if (a.amplitude > size) return true;
  return a.amplitude == b.amplitude && a.amplitude <= 0.0 && a.growth > b.growth * (1.0 + notable);
}

Badness badness_of(const detail::SampleResult& result) {
  if (result.verdict != Verdict::undecided && !result.hunts()) {
    return {-1.0, std::isnan(result.growth_at_rest) ? -1.0 : result.growth_at_rest};
  }
  return std::isnan(result.amplitude) ? Badness{-2.0, -1.0} : Badness{result.amplitude, 0.0};
}

/// The possible values of one parameter.
struct Coordinate {
  Bounds range;
  Values choices;  ///< to try, rising; empty where the whole range is

  double width() const { return range.high - range.low; }
  /// At a share of the range, or of the choices; below 1.
  double at(double share) const {
    if (choices.empty()) return range.low + share * width();
    return choices[static_cast<std::size_t>(share * static_cast<double>(choices.size()))];
  }
};

/// Lots have their values to try; of searched drives other parameters have their ends alone.
Coordinate coordinate_of(const Distribution& distribution, bool is_searched) {
  Coordinate coordinate{three_sigma_range_of(distribution), {}};
  if (is_searched) coordinate.choices = {coordinate.range.low, coordinate.range.high};
  if (const DiscreteLots* discrete = std::get_if<DiscreteLots>(&distribution)) {
    coordinate.choices = of_each(discrete->lots, &Lot::value);
    std::sort(coordinate.choices.begin(), coordinate.choices.end());
  }
  return coordinate;
}

struct Candidate {
  Values values;
  Badness badness;

  /// Takes the place of a worse one.
  void rise_to(const Candidate& other) {
    if (badness < other.badness) *this = other;
  }
};

/// The share of a searched drive's work is that of its searches; in closed form that of the climbs.
class ClimbProgress : public Progress {
 public:
  ClimbProgress(Progress& whole, const detail::SampleAnswers& answers)
      : whole_(whole), is_by_climbs_(!answers.are_one_by_one()) {}

  bool go_on(double share, std::size_t bytes = 0) override {
    return whole_.go_on(is_by_climbs_ ? climbs : share, bytes);
  }

  double climbs = 0.0;  ///< the share that is done

 private:
  Progress& whole_;
  bool is_by_climbs_;
};

class Climb {
 public:
  Climb(const TolerancedDrive& drive, const WorstSearch& search, const Workers& workers,
        Progress& progress)
      : search_(search),
        answers_(drive, no_target_, search.amplitude, workers, false),
        progress_(progress, answers_),
        shared_(progress_, search.samples + most_corners) {
    coordinates_ = of_each(drive.varied, [&](const ParameterTolerance& varied) {
      return coordinate_of(varied.distribution, answers_.are_one_by_one());
    });
  }

  Candidate worst() {
    std::vector<Candidate> starts = worst_of(corners());
    add_all(starts, worst_of(samples()));
    Candidate worst = starts.front();
    for (std::size_t i = 0; i < starts.size(); ++i) {
      progress_.climbs = static_cast<double>(i) / static_cast<double>(starts.size());
      worst.rise_to(climbed(starts[i]));
    }
    return worst;
  }

  const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  bool is_stopped() const { return shared_.is_stopped(); }
  detail::SampleResult result(const Values& values) { return answers_.of(values, shared_).front(); }

 private:
  static constexpr std::size_t most_corners = 64;  ///< of a searched drive

  std::vector<Values> corners() const {
    if (answers_.are_one_by_one() && std::size_t{1} << coordinates_.size() > most_corners) {
      return {};
    }
    return corners_of(of_each(coordinates_, &Coordinate::range));
  }

  std::vector<Values> samples() const {
    const SamplePlan sampling{.points = search_.samples, .replicates = 1};
    const std::size_t width = coordinates_.size();
    Values points(search_.samples * width);
    detail::ShiftedSobol(width, sampling).fill(0, 0, points);
    return of_each(indices(width > 0 ? search_.samples : 0), [&](std::size_t i) {
      return of_each(indices(width),
                     [&](std::size_t j) { return coordinates_[j].at(points[i * width + j]); });
    });
  }

  std::vector<Candidate> tried(const std::vector<Values>& all) {
    const std::vector<Badness> badness = evaluate(all);
    return of_each(indices(all.size()), [&](std::size_t i) {
      return Candidate{all[i], badness[i]};
    });
  }

  /// Of searched drives each is answered once: climbs come by corners that are known.
  std::vector<Badness> evaluate(const std::vector<Values>& all) {
    if (!answers_.are_one_by_one()) return answered(all);
    const std::vector<Values> open =
        those_of(all, [&](const Values& one) { return known_.try_emplace(one).second; });
    const std::vector<Badness> found = answered(open);
    for (std::size_t i = 0; i < open.size(); ++i) known_[open[i]] = found[i];
    return of_each(all, [&](const Values& one) { return known_.at(one); });
  }

  std::vector<Badness> answered(const std::vector<Values>& all) {
    if (all.empty()) return {};
    Values values;
    for (const Values& one : all) add_all(values, one);
    detail::SampleResults results(all.size());
    answers_.fill({.count = all.size(), .fill = rows_of(values, coordinates_.size()).fill}, results,
                  shared_);
    shared_.finish(answers_.are_one_by_one() ? all.size() : 0);
    return of_each(results, badness_of);
  }

  /// The worst `starts` of them, in falling order.
  std::vector<Candidate> worst_of(const std::vector<Values>& all) {
    std::vector<Candidate> worst = tried(all);
    std::stable_sort(worst.begin(), worst.end(), [](const Candidate& one, const Candidate& other) {
      return other.badness < one.badness;
    });
    if (worst.size() > search_.starts) worst.resize(search_.starts);
    return worst;
  }

  Candidate climbed(Candidate top) {
    constexpr int most_rounds = 200;
    for (int round = 0; round < most_rounds; ++round) {
      const Candidate before = top;
      for (std::size_t i = 0; i < coordinates_.size(); ++i) {
        if (is_stopped()) return top;
        if (!coordinates_[i].choices.empty()) {
          try_choices(top, i);
        } else {
          Values along(coordinates_.size(), 0.0);
          along[i] = coordinates_[i].width();
          try_line(top, along);
        }
      }
      if (!answers_.are_one_by_one()) {
        try_line(top, way_from(before, top));
        try_line(top, slope_at(top));
      }
      if (!is_notably_worse(top.badness, before.badness)) return top;
    }
    return top;
  }

  void try_choices(Candidate& top, std::size_t number) {
    std::vector<Values> all(coordinates_[number].choices.size(), top.values);
    for (std::size_t i = 0; i < all.size(); ++i) all[i][number] = coordinates_[number].choices[i];
    for (const Candidate& one : tried(all)) top.rise_to(one);
  }

  /// The displacement between two candidates; lots keep their values.
  Values way_from(const Candidate& before, const Candidate& now) const {
    return of_each(indices(coordinates_.size()), [&](std::size_t i) {
      return coordinates_[i].choices.empty() ? now.values[i] - before.values[i] : 0.0;
    });
  }

  /// The direction of steepest rise, with each parameter in units of its range. Components that
  /// lead out of the box are 0.
  Values slope_at(const Candidate& top) {
    constexpr double step = 1e-5;
    const std::size_t width = coordinates_.size();
    std::vector<Values> all;
    for (std::size_t i = 0; i < width; ++i) {
      for (const double side : {-step, step}) {
        all.push_back(top.values);
        if (!coordinates_[i].choices.empty()) continue;
        const Bounds& range = coordinates_[i].range;
        double& value = all.back()[i];
        value = std::clamp(value + side * coordinates_[i].width(), range.low, range.high);
      }
    }
    const std::vector<Badness> badness = evaluate(all);
    Values slope(width, 0.0);
    for (std::size_t i = 0; i < width; ++i) {
      const Badness& low = badness[2 * i];
      const Badness& high = badness[2 * i + 1];
      const double rise = low.amplitude == high.amplitude ? high.growth - low.growth
                                                          : high.amplitude - low.amplitude;
      if (!std::isfinite(rise)) continue;
      const bool leads_out = rise > 0.0 ? top.values[i] >= coordinates_[i].range.high
                                        : top.values[i] <= coordinates_[i].range.low;
      const double at = coordinates_[i].width();
      if (!leads_out) slope[i] = rise * at;
    }
    return slope;
  }

  /// Moves to the worst point of the line through `top` within the box.
  void try_line(Candidate& top, const Values& along) {
    Bounds reach{-infinity, infinity};
    for (std::size_t i = 0; i < along.size(); ++i) {
      if (along[i] == 0.0) continue;
      const double to_low = (coordinates_[i].range.low - top.values[i]) / along[i];
      const double to_high = (coordinates_[i].range.high - top.values[i]) / along[i];
      reach.low = std::max(reach.low, std::min(to_low, to_high));
      reach.high = std::min(reach.high, std::max(to_low, to_high));
    }
    if (!(reach.high > reach.low) || std::isinf(reach.high - reach.low)) return;
    refine_line(top, along, reach);
  }

  /// Zooms in repeatedly on the worst point found.
  void refine_line(Candidate& top, const Values& along, const Bounds& reach) {
    constexpr std::size_t points = 17;
    constexpr int most_refinements = 14;
    constexpr int enough_at_end = 6;  // refinements at an end of the line before stopping there
    const Values origin = top.values;
    double worst_way = 0.0;
    Bounds part = reach;
    int at_end = 0;
    for (int refinement = 0; refinement < most_refinements; ++refinement) {
      const double spacing = (part.high - part.low) / (points - 1);
      const auto way_to = [&](std::size_t k) {
        return k + 1 < points ? part.low + static_cast<double>(k) * spacing : part.high;
      };
      const std::vector<Candidate> all = tried(of_each(
          indices(points), [&](std::size_t k) { return point_of(origin, along, way_to(k)); }));
      const auto [least, worst] =
          std::minmax_element(all.begin(), all.end(), by(&Candidate::badness));
      if (top.badness < worst->badness) {
        top = *worst;
        worst_way = way_to(static_cast<std::size_t>(worst - all.begin()));
      }
      at_end = worst_way == reach.low || worst_way == reach.high ? at_end + 1 : 0;
      if (!is_notably_worse(top.badness, least->badness) || at_end == enough_at_end) return;
      part = {std::max(reach.low, worst_way - spacing), std::min(reach.high, worst_way + spacing)};
    }
  }

  Values point_of(const Values& origin, const Values& along, double way) const {
    Values values = origin;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (along[i] == 0.0) continue;
      const Bounds& range = coordinates_[i].range;
      const double value = origin[i] + way * along[i];
      const double rounding = 1e-14 * (range.high - range.low);
      values[i] = value;
      if (value <= range.low + rounding) values[i] = range.low;
      if (value >= range.high - rounding) values[i] = range.high;
    }
    return values;
  }

  const Target no_target_{};
  const WorstSearch& search_;
  detail::SampleAnswers answers_;
  ClimbProgress progress_;
  SharedProgress shared_;
  std::vector<Coordinate> coordinates_;
  std::map<Values, Badness> known_;
};

PlaceInRange place_of(double value, const Bounds& range) {
  if (range.low == range.high) return PlaceInRange::fixed;
  if (value == range.low) return PlaceInRange::at_low;
  return value == range.high ? PlaceInRange::at_high : PlaceInRange::inside;
}

}  // namespace

const char* name_of(PlaceInRange place) {
  constexpr Names<PlaceInRange::at_high> names("fixed", "at low", "inside", "at high");
  return names[place];
}

WorstCorner worst_corner(const TolerancedDrive& drive, const WorstSearch& search,
                         const Workers& workers, Progress& progress) {
  RangeCheck check;
  check.include(faults(drive));
  if (search.starts < 1) check.refuse("starts", "0", "must be at least 1");
  require_none(check.faults());
  Climb climb(drive, search, workers, progress);
  const Candidate top = climb.worst();
  WorstCorner worst;
  for (std::size_t i = 0; i < top.values.size(); ++i) {
    const double value = top.values[i];
    worst.numbers.push_back(
        {drive.varied[i].path, value, place_of(value, climb.coordinates()[i].range)});
  }
  worst.result = climb.result(top.values);
  worst.stopped = climb.is_stopped();
  return worst;
}

}  // namespace gearlash
