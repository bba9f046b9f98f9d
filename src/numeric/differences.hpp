// Derivatives by differences of ever smaller steps, with an estimate of their error.
#pragma once

#include <functional>
#include <vector>

namespace gearlash {

/// Numbers that depend on one, each NaN where it does not exist; no numbers: none exists.
using NumbersAt = std::function<std::vector<double>(double)>;

struct DifferenceSteps {
  double unit = 1.0;            ///< > 0: a change of the argument that changes the numbers much
  double first = 1.0 / 32;      ///< the longest step, as a share of the unit
  int halvings = 24;            ///< of the step, at most
  std::vector<double> sizes{};  ///< of the numbers; |number| at the present argument if not given
};

/// NaN if there is none.
struct Difference {
  double slope;
  double error;  ///< estimated
};

/// d(numbers)/dx at a present x: central differences of steps h, h/2, h/4, …, extrapolated to h = 0
/// (Ridders, Adv. Eng. Softw. 4, 1982, 75). Of all orders and steps the estimate is taken that
/// differs least from its neighbours, with larger steps and of lower order; that difference is its
/// error. Steps are halved until it is 1e-12 of max(|slope|, size/unit), or until it grows again.
/// Where numbers exist on one side alone, the slope is that of this side.
///
/// There is no slope where the error is above 1e-6 of max(|slope|, size/unit), nor where the slopes
/// of both sides differ by as much: at a kink, a jump, an edge where the numbers grow steep.
/// Rethrows what `numbers` throws.
std::vector<Difference> differences(const NumbersAt& numbers, double present,
                                    const DifferenceSteps& steps = {});

}  // namespace gearlash
