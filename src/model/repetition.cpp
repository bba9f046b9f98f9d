#include "gearlash/answer.hpp"

namespace gearlash {
namespace {

constexpr double same_swings = 1e-3;
constexpr double steady_pace = 0.05;  // of the mean period

}  // namespace

bool IrregularMotion::repeats() const {
  if (!mismatch || !mean_amplitude || !mean_period) return false;
  if (*mismatch <= same_swings) return true;
  if (!encoder_steps || !(*encoder_steps >= 1.0)) return false;
  const double spread = *amplitude_deviation / *mean_amplitude;
  return spread * *encoder_steps <= 1.0 && *period_deviation <= steady_pace * *mean_period;
}

}  // namespace gearlash
