// How the limit cycle depends on the parameters of a drive: exact derivatives.
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
};

/// Derivatives of the limit cycle seen in practice, the largest that is not unstable.
///
/// With a closed form: amplitude, period, frequency, multiplier and growth_at_rest, by forward
/// differentiation, not by differences; errors are about 1e-12 of the larger of derivative and
/// value/parameter.
///
/// Of other drives: amplitude, motor_amplitude, center, period and frequency of the cycle that
/// analyse() finds, by its variational equations with saltation (Leine & Nijmeijer, Dynamics and
/// Bifurcations of Non-Smooth Mechanical Systems, 2004, ch. 7), for every number that is neither 0
/// nor within 0.3 % of the end of its permitted range. Jacobian::reason says why a cycle has none:
/// a computer's ticks, an encoder's steps, infinitely many bounces in a period, a multiplier of 1.
/// They hold as long as the cycle has the same events. They take seconds: the search of the cycle.
/// If Progress stops it, the cycle is the one found by then, and the slopes not computed by then
/// are empty.
///
/// Throws InvalidInput for a drive that is unsound, for another quantity, and for a path that is no
/// number of the drive, or with a closed form does not enter it.
[[nodiscard]] Jacobian derivatives(const Drive& drive, std::span<const Quantity> quantities,
                                   std::span<const std::string_view> paths,
                                   Progress& progress = no_progress());
[[nodiscard]] Jacobian derivatives(const Drive& drive, std::initializer_list<Quantity> quantities,
                                   std::initializer_list<std::string_view> paths);

}  // namespace gearlash
