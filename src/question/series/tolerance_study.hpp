// Studies of a production run with given workers.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gearlash/tolerance.hpp"
#include "question/family/evaluation.hpp"
#include "question/series/samples.hpp"

namespace gearlash {

/// Every fault of the ranges, and of the target.
std::vector<Fault> faults(const StudyQuestions& questions);

/// As in gearlash/tolerance.hpp, with these workers.
ToleranceStudy study_tolerances(const TolerancedDrive& drive, const SamplePlan& sampling,
                                const StudyQuestions& questions, const Workers& workers,
                                Progress& progress = no_progress());

/// What samples do, from number `first` on, numbered replicate by replicate: of a whole study, or
/// of a part that is dealt out to one of several machines. Empty if progress stopped it. Throws
/// InvalidInput as study_tolerances(), and for samples that the plan does not have. Equal to those
/// of a whole study if it begins and ends between two blocks (block_of_samples).
std::optional<detail::SampleResults> answer_samples(const TolerancedDrive& drive,
                                                    const SamplePlan& sampling,
                                                    const StudyQuestions& questions,
                                                    std::size_t first, std::size_t count,
                                                    const Workers& workers, Progress& progress);

/// The study of what all samples do, in their order. Throws InvalidInput with the faults of the
/// sampling and the questions, and for another number of results.
ToleranceStudy study_of(const SamplePlan& sampling, const StudyQuestions& questions,
                        std::span<const detail::SampleResult> results, std::size_t threads = 0);

/// Solves varied.size() + 2 drives for each point: A and B, the two halves of Sobol points with
/// twice as many coordinates as varied parameters, and AB_i, which is A with column i of B. With m
/// the mean and V the variance of f(A) and f(B) together,
///   first order  S_i = Σ (f(B) − m)(f(AB_i) − f(A))/(N V)
///                (Saltelli et al., Comput. Phys. Commun. 181, 2010, Table 2 (b)),
///   total        T_i = Σ (f(A) − f(AB_i))²/(2 N V) (Jansen, Comput. Phys. Commun. 117, 1999).
/// Throws InvalidInput, as above.
SensitivityStudy study_sensitivities(const TolerancedDrive& drive, const SamplePlan& sampling,
                                     const StudyQuestions& questions, const Workers& workers,
                                     Progress& progress = no_progress());

}  // namespace gearlash
