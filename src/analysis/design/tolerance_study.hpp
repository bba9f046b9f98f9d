// What a production run of a drive will do: how many hunt, how big, how many meet a target, and
// which number's tolerance decides it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/design/sampling.hpp"
#include "analysis/design/target.hpp"
#include "analysis/design/toleranced_drive.hpp"
#include "analysis/grid/grid_evaluation.hpp"

namespace gearlash {

/// What a study is to find besides how many hunt.
struct StudyQuestions {
  Target target;                                               ///< for the yield
  std::vector<double> shares = {0.05, 0.25, 0.5, 0.75, 0.95};  ///< for quantiles; each 0 … 1
  std::size_t bins = 40;                                       ///< of the histogram; 0: none
};

/// Every fault of the ranges above, and of the target.
std::vector<Fault> validate(const StudyQuestions& questions);

struct QuantileEstimate {
  double share = 0.0;  ///< of pieces that do not exceed the value
  Estimate value;
};

/// How many have an amplitude from edges[i] to edges[i + 1], the last edge included; edges are
/// equally far apart, from the smallest amplitude above 0 to the largest that is finite.
struct AmplitudeHistogram {
  std::vector<double> edges;  ///< rad; one more than counts, or none
  std::vector<std::size_t> counts;
  std::size_t quiet = 0;    ///< amplitude 0
  std::size_t unknown = 0;  ///< amplitude not known or without bound
};

/// A drive hunts when it can go on oscillating, by itself or after a disturbance (any verdict but
/// cannot_hunt and undecided). Where an amplitude is not known (irregular hunting, undecided) it
/// counts as infinite in quantiles; such a drive meets no target. The mean is that of finite
/// amplitudes.
struct ToleranceStudy {
  SamplePlan sampling;
  Estimate hunting = {};                               ///< probability
  Estimate yield;                                      ///< probability of meeting the target
  Estimate mean_amplitude;                             ///< rad, 0 where quiet
  std::vector<QuantileEstimate> amplitude;             ///< rad, of all, 0 where quiet
  std::vector<QuantileEstimate> amplitude_of_hunting;  ///< rad, of those that hunt
  std::vector<QuantileEstimate> frequency;             ///< Hz, of those with a cycle
  AmplitudeHistogram histogram;
  std::size_t undecided = 0;
  std::size_t unknown_amplitudes = 0;
  std::size_t refused = 0;  ///< draws that were no drive; none after validate(TolerancedDrive)
  BatchCount solved;
  bool stopped = false;  ///< by progress: then nothing but the counts holds
};

/// By quasi-Monte-Carlo over all varied numbers. The same bits for any number of threads; 16 bytes
/// a sample are kept (amplitude and frequency, for the quantiles). Drives that bounce (restitution
/// above 0) are followed one by one, some milliseconds each: ask for few samples of these. Throws
/// InvalidInput with every fault of the drive, the sampling and the questions.
ToleranceStudy study_tolerances(const TolerancedDrive& drive, const SamplePlan& sampling = {},
                                const StudyQuestions& questions = {}, const Workers& workers = {},
                                Progress& progress = no_progress());

/// Sobol's indices of one varied number: what share of a variance goes if this number is made exact
/// (first order), and what share stays if all others are (total).
struct SensitivityIndices {
  Estimate first_order;
  Estimate total;
};

struct NumberSensitivity {
  std::string path;
  SensitivityIndices of_amplitude;  ///< 0 where quiet; NaN where the amplitude does not vary
  SensitivityIndices of_hunting;    ///< of the indicator, 0 or 1; NaN where all hunt, or none
};

struct SensitivityStudy {
  SamplePlan sampling;
  std::vector<NumberSensitivity> numbers;  ///< in the order of drive.varied
  Estimate amplitude_variance;             ///< rad²
  Estimate hunting_variance;               ///< p(1 − p)
  std::size_t left_out = 0;  ///< points with an amplitude that is not known or unbounded
  std::size_t refused = 0;
  bool stopped = false;
};

/// From matrices A and B, the two halves of Sobol points with twice as many coordinates as there
/// are varied numbers, and A with one column of B's, AB_i: varied.size() + 2 drives for each point.
///   first order  S_i = Σ (f(B) − m)(f(AB_i) − f(A))/(N V), m the mean of f(A) and f(B)
///                (Saltelli et al., Comput. Phys. Commun. 181, 2010, Table 2 (b)),
///   total        T_i = Σ (f(A) − f(AB_i))²/(2 N V) (Jansen, Comput. Phys. Commun. 117, 1999),
/// V being the variance of f(A) and f(B) together. Throws InvalidInput, as above.
SensitivityStudy study_sensitivities(const TolerancedDrive& drive, const SamplePlan& sampling = {},
                                     const Workers& workers = {},
                                     Progress& progress = no_progress());

}  // namespace gearlash
