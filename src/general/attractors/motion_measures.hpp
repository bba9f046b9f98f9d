// What is measured of a motion: where it turns, how its swings shrink, how fast neighbours part.
#pragma once

#include <limits>
#include <vector>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::drive {

/// A number that is looked at, and its derivative by time.
struct Watched {
  hybrid::AffineForm value;
  hybrid::AffineForm speed;
  /// The flow of each mode alone, with events where the speed changes its sign.
  hybrid::PreparedSystem turns;
};

Watched watched(const hybrid::HybridSystem& system, hybrid::AffineForm value,
                hybrid::AffineForm speed);

struct Sample {
  double time = 0.0;
  double value = 0.0;
};

/// The value at start, end, events and wherever it turns between them. Between events that are
/// within `short_time` of each other a turning is found only where the speed has changed its sign;
/// at 0 none is missed.
std::vector<Sample> samples(const hybrid::Trajectory& motion, const Watched& watched,
                            double short_time);

/// Highs and lows in turn.
std::vector<Sample> extremes(const std::vector<Sample>& samples);

struct Range {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void include(double value);
  double width() const { return highest - lowest; }
  double middle() const { return 0.5 * (lowest + highest); }
};

Range range_of(const std::vector<Sample>& samples);

/// The range of every number of the state over events, start and end.
std::vector<Range> ranges(const hybrid::Trajectory& motion, double from);

struct Spread {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();  ///< standard
};

Spread spread_of(const std::vector<double>& values);

/// Times at which the value passes a level upwards, after a time.
std::vector<double> upward_passings(const hybrid::Trajectory& motion, const Watched& watched,
                                    const std::vector<Sample>& samples, double level, double after);

/// Swings from one extreme to the next, compared with those some swings later: the least mean
/// difference there is, as a share of the mean swing; 0 for what repeats.
double least_mismatch(const std::vector<Sample>& extremes);

/// The largest exponent λ by which a small disturbance grows as exp(λt), mean over the motion: of a
/// disturbance of the first `own` numbers, carried through flows and events (saltation). 1/time.
double largest_exponent(const hybrid::HybridSystem& system, const hybrid::Trajectory& motion,
                        Eigen::Index own);

}  // namespace gearlash::drive
