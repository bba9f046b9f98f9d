// SUNDIALS CVODE with its own root finding: one solver for each mode, made once and reinitialised
// at events, with analytic Jacobians and the dense direct solver.
#pragma once

#include <memory>

#include "rival.hpp"

namespace gearlash::benchmarks {

enum class CvodeMethod {
  bdf,   ///< backward differentiation, Newton with the dense solver
  adams  ///< Adams–Moulton, fixed-point iteration: what suits these equations, which are not stiff
};

class CvodeRival {
 public:
  CvodeRival(const NormalizedServo& servo, CvodeMethod method);
  ~CvodeRival();
  CvodeRival(CvodeRival&&) noexcept;

  double follow_engagement(double& time, EngagedState& state, double face);
  double follow_gap(double& time, GapState4& state, double face);

 private:
  class Solver;
  std::unique_ptr<Solver> engaged_;
  std::unique_ptr<Solver> gap_;
  Coefficients servo_;
};

}  // namespace gearlash::benchmarks
