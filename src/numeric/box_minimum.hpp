// The least value of a function over a box, without derivatives or with them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace gearlash {

/// A function on the unit cube that may jump; empty: stop.
using FunctionOnCube = std::function<std::optional<double>(std::span<const double>)>;

struct CubeSearch {
  int global_evaluations = 60;  ///< of DIRECT-L (Gablonsky and Kelley 2001); 0: none
  int local_evaluations = 40;   ///< of Subplex (Rowan 1990), from the best point by then; 0: none
  double first_step = 0.1;      ///< of Subplex, along each coordinate
  double last_step = 1e-3;      ///< at which Subplex is content
};

struct CubeMinimum {
  std::vector<double> point{};
  double value = 0.0;
  std::size_t evaluations = 0;
  bool stopped = false;
};

/// The least value found. `start` is evaluated first. The same points in the same order on every
/// run. Rethrows what the function throws. Precondition: a start of at least one coordinate, each
/// 0 … 1.
CubeMinimum minimum_on_cube(const FunctionOnCube& function, std::span<const double> start,
                            const CubeSearch& search = {});

/// A number and its derivatives along the coordinates.
struct SlopedNumber {
  double value = 0.0;
  std::vector<double> slopes{};
};

struct SlopedNumbers {
  std::vector<SlopedNumber> sizes{};    ///< whose largest is to be small
  std::vector<SlopedNumber> limited{};  ///< none of which may be above 0
};

/// As many numbers at every point; empty where one of them has no derivatives.
using SlopesOnCube = std::function<std::optional<SlopedNumbers>(std::span<const double>)>;

/// The least of the largest size near a start, by SLSQP (Kraft, ACM TOMS 20, 1994), with that
/// largest as one more coordinate. Only points that keep all limits count. It turns back from
/// points without derivatives. Empty if the start has none, or no point keeps the limits. Rethrows
/// what the function throws. Precondition: a start of at least one coordinate, each 0 … 1.
std::optional<CubeMinimum> minimum_by_slopes(const SlopesOnCube& function,
                                             std::span<const double> start, int evaluations);

}  // namespace gearlash
