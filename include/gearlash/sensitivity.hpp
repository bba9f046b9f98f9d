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
#include "gearlash/quantity.hpp"

namespace gearlash {

/// The derivatives of quantities with respect to parameters, in SI. A quantity that does not exist
/// is empty: without a limit cycle only growth at rest exists.
struct Jacobian {
  std::vector<Quantity> quantities{};
  std::vector<std::string> paths{};
  std::vector<std::optional<double>> values{};  ///< of the quantities
  std::vector<double> present{};                ///< of the parameters
  std::vector<std::optional<double>> slopes{};  ///< quantity by quantity; see slope()

  /// ∂ quantities[quantity]/∂ paths[parameter]. Throws std::out_of_range.
  [[nodiscard]] std::optional<double> slope(std::size_t quantity, std::size_t parameter) const;
  /// ∂ ln quantity/∂ ln parameter: per cent per one per cent; 0 where the parameter is 0. Throws
  /// std::out_of_range.
  [[nodiscard]] std::optional<double> elasticity(std::size_t quantity, std::size_t parameter) const;
};

/// Derivatives of the limit cycle seen in practice, the largest stable one (amplitude, period,
/// frequency, multiplier), and of growth_at_rest. Computed by forward differentiation of the closed
/// form, not by differences; errors are about 1e-12 of the larger of derivative and
/// value/parameter. Throws InvalidInput for a drive that is unsound or has no closed form, for
/// another quantity, and for a path that does not enter the closed form.
[[nodiscard]] Jacobian derivatives(const Drive& drive, std::span<const Quantity> quantities,
                                   std::span<const std::string_view> paths);
[[nodiscard]] Jacobian derivatives(const Drive& drive, std::initializer_list<Quantity> quantities,
                                   std::initializer_list<std::string_view> paths);

}  // namespace gearlash
