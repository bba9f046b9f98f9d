// A production run: the shares that hunt and that meet a target, and the tolerances responsible.
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

/// The same value in every sample.
struct ExactValue {
  double value = 0.0;  ///< in the parameter's SI unit

  bool operator==(const ExactValue&) const = default;
};

/// Uniform from `min` to `max`.
struct UniformBetween {
  double min = 0.0;  ///< in the parameter's SI unit
  double max = 0.0;  ///< ≥ min

  bool operator==(const UniformBetween&) const = default;
};

/// Uniform from nominal − tolerance to nominal + tolerance; the tolerance is absolute, ≥ 0.
struct UniformAbout {
  double nominal = 0.0;    ///< in the parameter's SI unit
  double tolerance = 0.0;  ///< in the same unit, ≥ 0

  bool operator==(const UniformAbout&) const = default;
};

/// "± 10 %" is a share of 0.1.
[[nodiscard]] inline UniformAbout within_share(double nominal, double share) {
  return {nominal, share * nominal};
}

/// Normal distribution, density ∝ exp(−(x − mean)²/(2 standard_deviation²)), truncated at `min` and
/// `max` where given. Mean and standard deviation are those before truncation. Permitted:
/// standard_deviation > 0, min < max, min < mean + 3 standard deviations, max > mean − 3 standard
/// deviations.
struct Normal {
  double mean = 0.0;                ///< in the parameter's SI unit
  double standard_deviation = 1.0;  ///< in the same unit, > 0
  std::optional<double> min{};      ///< none if empty
  std::optional<double> max{};      ///< none if empty

  bool operator==(const Normal&) const = default;
};

struct Lot {
  double value = 0.0;   ///< in the parameter's SI unit
  double weight = 1.0;  ///< > 0; only ratios of weights matter

  bool operator==(const Lot&) const = default;
};

/// One of several values with probabilities proportional to their weights: lots from several
/// makers, gear wheels of several ratios. At least one lot.
struct DiscreteLots {
  std::vector<Lot> lots{};  ///< at least one

  bool operator==(const DiscreteLots&) const = default;
};

using Distribution = std::variant<ExactValue, UniformBetween, UniformAbout, Normal, DiscreteLots>;

/// A parameter of a drive, by its path, that varies from sample to sample.
struct ParameterTolerance {
  std::string path{};           ///< of a number of the drive
  Distribution distribution{};  ///< independent of the other parameters

  bool operator==(const ParameterTolerance&) const = default;
};

struct TolerancedDrive {
  Drive nominal{};                           ///< its varied parameters have no effect
  std::vector<ParameterTolerance> varied{};  ///< each path once

  bool operator==(const TolerancedDrive&) const = default;
};

/// Every fault: parameters that are no numbers of the drive or are given twice; invalid
/// distributions, and distributions that can yield a value the parameter must not have; nominal
/// values. If each parameter is valid by itself, all corners of the box of drawn values, and of the
/// support (cut at three standard deviations), must be sound drives; of more than ten parameters
/// that are searched, the ends of each. Where the closed form answers for the drive and for all
/// that varies, it must answer for the corners too; backlashes between 0 and 1e-15 rad, which a
/// drive must not have, may then be drawn, because amplitudes are computed per unit of backlash.
[[nodiscard]] std::vector<Fault> faults(const TolerancedDrive& drive);

// ---- how it is drawn ----------------------------------------------------------------------------

/// Quasi-random points: the first `points` of Sobol's sequence (Gray-code order, direction numbers
/// of Joe and Kuo, SIAM J. Sci. Comput. 30, 2008). Each replicate applies its own independent
/// random digital shift (exclusive or with random bits). So each replicate is unbiased, and the
/// scatter of the replicates estimates the error (Owen; L'Ecuyer and Lemieux, 2002).
struct SamplePlan {
  std::size_t points = 4096;    ///< of a replicate, ≥ 1; powers of two cover the cube evenly
  std::size_t replicates = 16;  ///< ≥ 2
  std::uint64_t seed = 1960;    ///< of the shifts; equal seeds give equal bits on every machine

  /// points × replicates at most: 2²⁴. A study keeps every sample, in 48 bytes: 0.8 GB.
  static constexpr std::size_t most_samples = 16'777'216;
  [[nodiscard]] std::size_t samples() const { return points * replicates; }
  bool operator==(const SamplePlan&) const = default;
};

/// The smallest plan with at least `samples` samples and a power of two as `points`.
[[nodiscard]] SamplePlan sampling_of(std::size_t samples, const SamplePlan& like = {});

/// A number estimated from a sample.
struct Estimate {
  double value = 0.0;  ///< the estimate
  /// The standard deviation of the replicates' values divided by √replicates. Empty where fewer
  /// than two replicates give a value, or one gives an infinite value.
  std::optional<double> standard_error{};
};

// ---- how the drives behave ----------------------------------------------------------------------

/// What a study computes besides the probability of hunting.
struct StudyQuestions {
  Quantity amplitude = Quantity::amplitude;                    ///< of the load, or motor_amplitude
  Target target{};                                             ///< for the yield
  std::vector<double> shares = {0.05, 0.25, 0.5, 0.75, 0.95};  ///< for quantiles; each 0 … 1
  std::size_t bins = 40;                                       ///< of the histogram; 0: none
};

/// 65,536 samples in closed form, which take a fraction of a second; 512 one by one and with
/// bounces, and 64 of drives that are searched, which take seconds to minutes. Precondition: a
/// drive without faults().
[[nodiscard]] SamplePlan usual_sampling(const TolerancedDrive& drive,
                                        const StudyQuestions& questions = {});

struct QuantileEstimate {
  double share = 0.0;               ///< share of the samples that do not exceed the value
  std::optional<Estimate> value{};  ///< empty where there are no such samples
};

/// counts[i] drives have an amplitude from edges[i] to edges[i + 1]; the last edge is included. The
/// edges are equally spaced from the smallest amplitude above 0 to the largest finite one.
struct AmplitudeHistogram {
  std::vector<double> edges{};        ///< rad; one more than counts, or none
  std::vector<std::size_t> counts{};  ///< of drives
  std::size_t quiet = 0;              ///< amplitude 0
  std::size_t unknown = 0;            ///< amplitude unknown or unbounded
};

/// A drive hunts if it can oscillate permanently, by itself or after a disturbance, or runs away
/// (any verdict but cannot_hunt, comes_to_rest, forced and undecided). The amplitude of a drive
/// that grows without bound or runs away is infinite. An unknown amplitude (irregular hunting,
/// undecided) counts as infinite in quantiles, and such a drive meets no target. The mean covers
/// finite amplitudes only. Quantiles are order statistics of all samples: that of the share p of n
/// values lies between the two whose mid-ranks (k − ½)/n are nearest to p (Hazen).
struct ToleranceStudy {
  SamplePlan sampling{};                                 ///< as it was taken
  Estimate hunting{};                                    ///< probability
  Estimate yield{};                                      ///< probability of meeting the target
  std::optional<Estimate> mean_amplitude{};              ///< rad, 0 where quiet
  std::vector<QuantileEstimate> amplitude{};             ///< rad, of all drives; 0 where quiet
  std::vector<QuantileEstimate> amplitude_of_hunting{};  ///< rad, of the drives that hunt
  std::vector<QuantileEstimate> error{};                 ///< rad, in the end, of all drives
  std::vector<QuantileEstimate> frequency{};             ///< Hz, of the drives with a cycle
  AmplitudeHistogram histogram{};                        ///< of amplitudes above 0
  std::size_t undecided = 0;           ///< samples of which it is not known whether they hunt
  std::size_t unknown_amplitudes = 0;  ///< samples whose amplitude is not known
  /// Samples that meet the target, which limits the amplitude and no error, and end farther off.
  std::size_t hidden_errors = 0;
  std::size_t refused = 0;  ///< draws that are no valid drive; 0 for a drive without faults()
  /// By Progress: then `hunting` and `yield` are the shares of the `answered` samples, and nothing
  /// else holds.
  bool stopped = false;
  std::size_t answered = 0;  ///< samples of which it is known whether they hunt
};

/// Quasi-Monte Carlo over all varied parameters, on all cores, with the same bits for any number of
/// cores. Memory: SamplePlan::most_samples. With plastic contact it solves millions of drives per
/// second. A drive that bounces takes some milliseconds, so use few samples there; a drive without
/// a closed form, which analyse() searches, some tenths of a second. Throws InvalidInput with every
/// fault of the drive, the sampling and the questions.
[[nodiscard]] ToleranceStudy study_tolerances(const TolerancedDrive& drive,
                                              const SamplePlan& sampling = {},
                                              const StudyQuestions& questions = {},
                                              Progress& progress = no_progress());

/// study_tolerances() with the fewest points, of those of `sampling` doubled again and again, that
/// give the probability of hunting, and the yield if there is a target, to within `error`: two
/// standard errors, and 3/samples, which is what 95 % of runs without an exception leave open. Up
/// to SamplePlan::most_samples: where they do not suffice, the standard errors say so. Permitted:
/// 1e-6 ≤ error ≤ 0.5. Throws InvalidInput, as above.
[[nodiscard]] ToleranceStudy study_tolerances_to(double error, const TolerancedDrive& drive,
                                                 const SamplePlan& sampling = {},
                                                 const StudyQuestions& questions = {},
                                                 Progress& progress = no_progress());

// ---- which tolerance is responsible -------------------------------------------------------------

/// Sobol's indices of one varied parameter: the share of a variance that disappears if this
/// parameter is made exact (first order), and the share that remains if all others are (total).
struct SensitivityIndices {
  Estimate first_order{};  ///< alone
  Estimate total{};        ///< with all interactions
};

struct NumberSensitivity {
  std::string path{};                                ///< of the parameter
  std::optional<SensitivityIndices> of_amplitude{};  ///< 0 where quiet; empty if it does not vary
  std::optional<SensitivityIndices>
      of_hunting{};  ///< of the indicator; empty if all drives or none hunt
};

struct SensitivityStudy {
  SamplePlan sampling{};                     ///< as it was taken
  std::vector<NumberSensitivity> numbers{};  ///< in the order of TolerancedDrive::varied
  Estimate amplitude_variance{};             ///< rad²
  Estimate hunting_variance{};               ///< p(1 − p)
  std::size_t left_out = 0;                  ///< points whose amplitude is unknown or unbounded
  std::size_t refused = 0;                   ///< draws that are no valid drive
  bool stopped = false;                      ///< by Progress: then nothing holds
};

/// Solves varied.size() + 2 drives for each point of the plan. Of the questions it reads which
/// amplitude is meant. Throws InvalidInput, as above.
[[nodiscard]] SensitivityStudy study_sensitivities(const TolerancedDrive& drive,
                                                   const SamplePlan& sampling = {},
                                                   const StudyQuestions& questions = {},
                                                   Progress& progress = no_progress());

// ---- how much backlash production may permit ----------------------------------------------------

struct BacklashDemand {
  Target target{};      ///< without a lower limit of amplitude
  double yield = 0.95;  ///< share of samples that must meet the target, above 0 to 1
  /// The lower limit of the backlash's tolerance, rad, ≥ 0. Default: the lowest value of a backlash
  /// that varies (drawn_range_of()), else its nominal value.
  std::optional<double> min{};
};

struct WidestBacklash {
  double min = 0.0;  ///< rad
  double max = 0.0;  ///< rad; infinite where backlash does not matter
  Estimate yield{};  ///< with a backlash that is uniform from min to max
  /// The values of max at which the estimated yield equals the demanded one plus, and minus, its
  /// standard error.
  Bounds uncertainty{};
  bool stopped = false;  ///< by Progress: then nothing holds
};

/// The largest max for which at least the demanded share of the samples meet the target. The
/// backlash is uniform from min to max; the other parameters vary as specified. Empty where not
/// even max = min gives the yield. Throws InvalidInput with every fault of the drive, the demand
/// and the sampling.
[[nodiscard]] std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                                            const BacklashDemand& demand,
                                                            const SamplePlan& sampling = {},
                                                            Progress& progress = no_progress());

}  // namespace gearlash
