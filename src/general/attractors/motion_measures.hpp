// Measures a motion: its turns, the decay of its swings, the divergence of neighbours.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "base/extent.hpp"
#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::drive {

/// A watched number and its time derivative.
struct Watched {
  hybrid::AffineForm value;
  hybrid::AffineForm speed;
  /// The flow of each mode alone, with events where the speed changes its sign.
  hybrid::PreparedSystem turns;
};

Watched watched(const hybrid::HybridSystem& system, hybrid::AffineForm value,
                hybrid::AffineForm speed);

/// The largest size of a form that is one of each mode's, empty where it is not looked at: at
/// start, end, events and every turn between them. `system`: the motion's.
double largest_size(const hybrid::Trajectory& motion, const hybrid::HybridSystem& system,
                    const std::function<std::optional<hybrid::AffineForm>(std::size_t)>& form_of);

struct Sample {
  double time = 0.0;
  double value = 0.0;
};

/// The value at start, end, events and every turn between them. None is missed.
std::vector<Sample> samples(const hybrid::Trajectory& motion, const Watched& watched);

/// The same, faster. A change of the speed's sign from one step of the series to the
/// next reveals a turn, so that two turns within one step are missed.
std::vector<Sample> rough_samples(const hybrid::Trajectory& motion, const Watched& watched);

/// Highs and lows, alternating, each farther than `least` from the one before.
std::vector<Sample> extremes(const std::vector<Sample>& samples, double least = 0.0);

/// Those not before a time.
std::vector<Sample> after(const std::vector<Sample>& all, double from);

Extent extent_of(const std::vector<Sample>& samples);

/// The range of every number of the state over events, start and end, from one time to another.
std::vector<Extent> extents(const hybrid::Trajectory& motion, double from,
                            double to = std::numeric_limits<double>::infinity());

struct Spread {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();  ///< standard
};

Spread spread_of(const std::vector<double>& values);

/// Times at which the value passes a level upwards, after a given time.
std::vector<double> upward_passings(const hybrid::Trajectory& motion, const Watched& watched,
                                    const std::vector<Sample>& samples, double level, double after);

/// The same for a value of which only the extremes are known. Between two of them it is taken to go
/// like a cosine.
std::vector<double> upward_passings(const std::vector<Sample>& extremes, double level);

/// The size that a value exceeds for a share of its time. Between two samples it is taken to go
/// like a cosine from turn to turn. Precondition: more than one sample, none of its turns missing.
double size_exceeded_for(double share, const std::vector<Sample>& samples);

/// Compares swings from one extreme to the next with those some swings later. Returns the least
/// mean difference as a share of the mean swing; 0 for a repeating motion. Long lists are judged by
/// their last part.
double least_mismatch(const std::vector<Sample>& extremes);

/// The largest exponent λ by which a small disturbance grows as exp(λt), mean over the motion. The
/// disturbance is of the first `own` numbers, carried through flows and events (saltation). 1/time.
double largest_exponent(const hybrid::HybridSystem& system, const hybrid::Trajectory& motion,
                        Eigen::Index own);

}  // namespace gearlash::drive
