// A production run: how many drives hunt, how large, how many meet a target, and which tolerance
// decides it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

// ---- what varies --------------------------------------------------------------------------------

/// The same in every sample.
struct ExactValue {
  double value = 0.0;

  bool operator==(const ExactValue&) const = default;
};

/// Every value from `min` to `max` is as likely.
struct UniformBetween {
  double min = 0.0;
  double max = 0.0;

  bool operator==(const UniformBetween&) const = default;
};

/// Likewise, from nominal − tolerance to nominal + tolerance; the tolerance is absolute, ≥ 0.
struct UniformAbout {
  double nominal = 0.0;
  double tolerance = 0.0;

  bool operator==(const UniformAbout&) const = default;
};

/// "± 10 %" is a share of 0.1.
[[nodiscard]] inline UniformAbout within_share(double nominal, double share) {
  return {nominal, share * nominal};
}

/// Gauss's, density ∝ exp(−(x − mean)²/(2 standard_deviation²)), of which samples below `min` or
/// above `max` are sorted out where those are given; mean and standard deviation are those before
/// the sorting. standard_deviation > 0, min < max, min < mean + 3 standard deviations and max >
/// mean − 3 standard deviations.
struct Normal {
  double mean = 0.0;
  double standard_deviation = 1.0;
  std::optional<double> min{};
  std::optional<double> max{};

  bool operator==(const Normal&) const = default;
};

struct Lot {
  double value = 0.0;
  double weight = 1.0;  ///< > 0; only ratios of weights matter

  bool operator==(const Lot&) const = default;
};

/// One of several values, each as likely as its weight says: lots of several makers, gear wheels of
/// several ratios. At least one lot.
struct DiscreteLots {
  std::vector<Lot> lots{};

  bool operator==(const DiscreteLots&) const = default;
};

using Distribution = std::variant<ExactValue, UniformBetween, UniformAbout, Normal, DiscreteLots>;

/// A parameter of a drive, by its path, that differs from sample to sample.
struct ParameterTolerance {
  std::string path{};
  Distribution distribution{};  ///< independent of those of the others

  bool operator==(const ParameterTolerance&) const = default;
};

struct TolerancedDrive {
  Drive nominal{};  ///< with a closed form; of varied parameters without effect
  std::vector<ParameterTolerance> varied{};

  bool operator==(const TolerancedDrive&) const = default;
};

/// Every fault: parameters on which the closed form does not depend, or that are given twice;
/// distributions that are none, or of which a value is drawn that no such parameter can have;
/// nominal values. Where each parameter is possible by itself, all corners of the box of the values
/// drawn, and of the support (cut at three standard deviations), have to be drives with a closed
/// form. A backlash between 0 and 1e-15 rad, which a drive must not have, may be drawn: amplitudes
/// are worked out per backlash.
[[nodiscard]] std::vector<Fault> faults(const TolerancedDrive& drive);

// ---- how it is drawn ----------------------------------------------------------------------------

/// Quasi-random points: the first `points` of Sobol's sequence (Gray-code order, direction numbers
/// of Joe and Kuo, SIAM J. Sci. Comput. 30, 2008), several times over, each time shifted digit by
/// digit (exclusive or) with random bits, independently from replicate to replicate, so that each
/// replicate is without bias and their scatter tells the error (Owen; L'Ecuyer and Lemieux, 2002).
struct SamplePlan {
  std::size_t points = 4096;    ///< of a replicate, ≥ 1; even over the cube at powers of two
  std::size_t replicates = 16;  ///< ≥ 2
  std::uint64_t seed = 1960;    ///< of the shifts; the same seed, the same bits on every machine

  [[nodiscard]] std::size_t samples() const { return points * replicates; }
  bool operator==(const SamplePlan&) const = default;
};

/// The least plan with at least so many samples whose points are a power of two.
[[nodiscard]] SamplePlan sampling_of(std::size_t samples, const SamplePlan& like = {});

/// A number found from a sample.
struct Estimate {
  double value = 0.0;
  /// Of the value: the standard deviation over the replicates, divided by √replicates; nothing
  /// where fewer than two of them give a value, or an infinite one.
  std::optional<double> standard_error{};
};

// ---- what it does -------------------------------------------------------------------------------

/// What a study is to find besides how many hunt.
struct StudyQuestions {
  Target target{};                                             ///< for the yield
  std::vector<double> shares = {0.05, 0.25, 0.5, 0.75, 0.95};  ///< for quantiles; each 0 … 1
  std::size_t bins = 40;                                       ///< of the histogram; 0: none
};

struct QuantileEstimate {
  double share = 0.0;               ///< of samples that do not exceed the value
  std::optional<Estimate> value{};  ///< nothing where there are no such samples
};

/// How many have an amplitude from edges[i] to edges[i + 1], the last edge included; edges are
/// equally far apart, from the smallest amplitude above 0 to the largest that is finite.
struct AmplitudeHistogram {
  std::vector<double> edges{};  ///< rad; one more than counts, or none
  std::vector<std::size_t> counts{};
  std::size_t quiet = 0;    ///< amplitude 0
  std::size_t unknown = 0;  ///< amplitude not known or without bound
};

/// A drive hunts when it can go on oscillating, by itself or after a disturbance (any verdict but
/// cannot_hunt and undecided). Where an amplitude is not known (irregular hunting, undecided) it
/// counts as infinite in quantiles; such a drive meets no target. The mean is that of finite
/// amplitudes.
struct ToleranceStudy {
  SamplePlan sampling{};
  Estimate hunting{};                                    ///< probability
  Estimate yield{};                                      ///< probability of meeting the target
  std::optional<Estimate> mean_amplitude{};              ///< rad, 0 where quiet
  std::vector<QuantileEstimate> amplitude{};             ///< rad, of all, 0 where quiet
  std::vector<QuantileEstimate> amplitude_of_hunting{};  ///< rad, of those that hunt
  std::vector<QuantileEstimate> frequency{};             ///< Hz, of those with a cycle
  AmplitudeHistogram histogram{};
  std::size_t undecided = 0;
  std::size_t unknown_amplitudes = 0;
  std::size_t refused = 0;  ///< draws that were no drive; none of a drive without faults()
  bool stopped = false;     ///< by Progress: then nothing but the counts holds
};

/// By quasi-Monte-Carlo over all varied numbers, on all cores, the same bits for any number of
/// them; 16 bytes a sample are kept. Millions a second with plastic contact; drives that bounce
/// take some milliseconds each: ask for few samples of these. Throws InvalidInput with every fault
/// of the drive, the sampling and the questions.
[[nodiscard]] ToleranceStudy study_tolerances(const TolerancedDrive& drive,
                                              const SamplePlan& sampling = {},
                                              const StudyQuestions& questions = {},
                                              Progress& progress = no_progress());

// ---- what decides it ----------------------------------------------------------------------------

/// Sobol's indices of one varied number: what share of a variance goes if this number is made exact
/// (first order), and what share stays if all others are (total).
struct SensitivityIndices {
  Estimate first_order{};
  Estimate total{};
};

struct NumberSensitivity {
  std::string path{};
  std::optional<SensitivityIndices> of_amplitude{};  ///< 0 where quiet; nothing if it does not vary
  std::optional<SensitivityIndices>
      of_hunting{};  ///< of the indicator; nothing if all or none hunt
};

struct SensitivityStudy {
  SamplePlan sampling{};
  std::vector<NumberSensitivity> numbers{};  ///< in the order of TolerancedDrive::varied
  Estimate amplitude_variance{};             ///< rad²
  Estimate hunting_variance{};               ///< p(1 − p)
  std::size_t left_out = 0;  ///< points with an amplitude that is not known or unbounded
  std::size_t refused = 0;
  bool stopped = false;
};

/// From varied.size() + 2 drives for each point of the plan. Throws InvalidInput, as above.
[[nodiscard]] SensitivityStudy study_sensitivities(const TolerancedDrive& drive,
                                                   const SamplePlan& sampling = {},
                                                   Progress& progress = no_progress());

// ---- how much backlash production may let through -----------------------------------------------

struct BacklashDemand {
  Target target{};      ///< without a lower limit of amplitude
  double yield = 0.95;  ///< share of samples that are to meet the target, above 0 to 1
  /// The lower limit of the backlash's tolerance, rad, ≥ 0. Without it: the lowest value of the
  /// backlash where it varies (drawn_range_of()), its nominal value where it does not.
  std::optional<double> min{};
};

struct WidestBacklash {
  double min = 0.0;  ///< rad
  double max = 0.0;  ///< rad; infinite where backlash does not matter
  Estimate yield{};  ///< with a backlash that is uniform from min to max
  /// The limits with which the estimated yield would be the demanded one plus its standard error,
  /// and less it.
  Bounds uncertainty{};
  bool stopped = false;  ///< by progress: nothing holds
};

/// The largest max with which at least the demanded share of the samples meet the target, their
/// backlash being uniform from min to max and the other parameters as they vary. Nothing where not
/// even max = min gives the yield. Throws InvalidInput with every fault of the drive, the demand
/// and the sampling.
[[nodiscard]] std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                                            const BacklashDemand& demand,
                                                            const SamplePlan& sampling = {},
                                                            Progress& progress = no_progress());

}  // namespace gearlash
