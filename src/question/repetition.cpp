#include "question/repetition.hpp"

namespace gearlash {
namespace {

constexpr double same_swings = 1e-3;
constexpr double steady_pace = 0.05;  // of the mean period

}  // namespace

bool repeats(const IrregularMotion& motion) {
  if (!motion.mismatch || !motion.mean_amplitude || !motion.mean_period) return false;
  if (*motion.mismatch <= same_swings) return true;
  if (!motion.encoder_steps || !(*motion.encoder_steps >= 1.0)) return false;
  const double spread = *motion.amplitude_deviation / *motion.mean_amplitude;
  return spread * *motion.encoder_steps <= 1.0 &&
         *motion.period_deviation <= steady_pace * *motion.mean_period;
}

}  // namespace gearlash
