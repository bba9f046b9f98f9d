// How the numbers of a hybrid system change with one parameter.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "hybrid/hybrid_system.hpp"
#include "numeric/central_difference.hpp"

namespace gearlash::hybrid {

/// The system for a parameter's value. The state's numbers and the modes stay the same.
using Family = std::function<HybridSystem(double parameter)>;

/// ∂/∂parameter of a mode's numbers, of the same shapes.
struct ModeSlopes {
  AffineFlow flow;
  std::vector<AffineForm> guards;     ///< by transition
  std::vector<AffineFlow> resets;     ///< by transition: of matrix x + offset
  std::vector<AffineFlow> settlings;  ///< likewise; empty matrices where it has none
};

/// The slopes of all modes at one value of the parameter, by central differences of sixth order,
///   f′ ≈ (45 (f₁ − f₋₁) − 9 (f₂ − f₋₂) + (f₃ − f₋₃))/60h,  fₖ = f(parameter + kh).
/// Entries of a system are rational in its parameters; with h a thousandth of the parameter their
/// error is about 1e-13 of f/h·1e-3.
class SystemSlopes {
 public:
  /// Makes the systems at parameter ± h, ± 2h and ± 3h. Precondition: step > 0. Throws what the
  /// family throws.
  SystemSlopes(const Family& family, double parameter, double step);

  /// nullptr where the parameter changes the shape of the mode, or a quantizer acts in it.
  const ModeSlopes* mode(std::size_t index) const;

 private:
  static constexpr std::size_t pairs = difference_weights.size();
  std::optional<ModeSlopes> made(std::size_t index) const;

  double step_;
  std::array<HybridSystem, pairs> above_;
  std::array<HybridSystem, pairs> below_;
  mutable std::map<std::size_t, std::optional<ModeSlopes>> modes_;
};

}  // namespace gearlash::hybrid
