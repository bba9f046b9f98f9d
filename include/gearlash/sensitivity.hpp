// How the limit cycle depends on the parameters of a drive: derivatives.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"
#include "gearlash/quantity.hpp"

namespace gearlash {

/// The derivatives of quantities with respect to parameters, in SI. A quantity that does not exist
/// is empty: without a limit cycle only growth at rest exists. So is a slope that does not exist or
/// is not computed.
struct Jacobian {
  std::vector<Quantity> quantities{};           ///< the rows
  std::vector<std::string> paths{};             ///< of the parameters, the columns
  std::vector<std::optional<double>> values{};  ///< of the quantities
  std::vector<double> present{};                ///< of the parameters
  std::vector<std::optional<double>> slopes{};  ///< quantity by quantity; see slope()
  std::string reason{};  ///< why the limit cycle has no derivatives; empty if it has

  /// ∂ quantities[quantity]/∂ paths[parameter]. Throws std::out_of_range.
  [[nodiscard]] std::optional<double> slope(std::size_t quantity, std::size_t parameter) const;
  /// ∂ ln quantity/∂ ln parameter: per cent per one per cent; 0 where the parameter is 0. Throws
  /// std::out_of_range.
  [[nodiscard]] std::optional<double> elasticity(std::size_t quantity, std::size_t parameter) const;
  /// elasticity() of each of `slopes`.
  [[nodiscard]] std::vector<std::optional<double>> elasticities()
      const;  ///< per cent per one per cent, in the order of `slopes`
};

/// Derivatives of the limit cycle seen in practice, the largest that is not unstable.
///
/// By differences of the answers at neighbouring values, extrapolated (Ridders 1982), with steps
/// chosen so that two estimates agree: to about 1e-9 of the larger of derivative and
/// value/parameter, less next to the boundary of hunting and for cycles that hardly resist
/// disturbances. A slope whose estimates differ by more than 1e-6 of that, or which is another one
/// on either side, is empty. At the end of a permitted range it is that of the permitted side.
///
/// With a closed form: amplitude, period, frequency, multiplier and growth_at_rest. By a
/// restitution of 0 all slopes are 0 (docs/explanation/servo.md, Derivatives).
///
/// Of other drives: amplitude, motor_amplitude, center, period and frequency of the cycle that
/// analyse() finds, followed by Newton's method, for every number that is not 0. Jacobian::reason
/// says why a cycle has none: a computer's ticks, an encoder's steps, infinitely many bounces in a
/// period, a multiplier of 1. They hold as long as the cycle has the same events. They take
/// seconds: the search of the cycle. If Progress stops it, the cycle is the one found by then, and
/// the slopes not computed by then are empty.
///
/// Throws InvalidInput for a drive that is unsound, for another quantity, and for a path that is no
/// number of the drive, or with a closed form does not enter it.
[[nodiscard]] Jacobian derivatives(const Drive& drive, std::span<const Quantity> quantities,
                                   std::span<const std::string_view> paths,
                                   Progress& progress = no_progress());
[[nodiscard]] Jacobian derivatives(const Drive& drive, std::initializer_list<Quantity> quantities,
                                   std::initializer_list<std::string_view> paths);

}  // namespace gearlash
