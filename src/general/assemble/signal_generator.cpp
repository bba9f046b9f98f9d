#include "general/assemble/signal_generator.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace gearlash::drive {
namespace {

using hybrid::Matrix;
using hybrid::Vector;

Generator generator_of(const Sine& sine) {
  return {Matrix{{0.0, sine.frequency}, {-sine.frequency, 0.0}},
          Vector{{sine.amplitude, 0.0}},
          sine.mean,
          Vector{{std::sin(sine.phase), std::cos(sine.phase)}},
          {},
          {}};
}

}  // namespace

Generator generator_of(const Signal& signal) {
  if (const auto* sine = std::get_if<Sine>(&signal)) return generator_of(*sine);
  const std::vector<SignalStretch> all = stretches(signal);
  Eigen::Index size = all.size() > 1 ? 1 : 0;
  for (const SignalStretch& stretch : all) {
    if (stretch.rate != 0.0) size = std::max<Eigen::Index>(size, 2);
    if (stretch.acceleration != 0.0) size = 3;
  }
  Generator generator{Matrix::Zero(size, size), Vector::Zero(size), 0.0, {}, {}, {}};
  for (Eigen::Index i = 0; i + 1 < size; ++i) generator.flow(i, i + 1) = 1.0;
  if (size == 0) {
    generator.offset = all.front().value;
  } else {
    generator.output[0] = 1.0;
  }
  const auto setting_of = [&](const SignalStretch& stretch) {
    return Vector(Eigen::Vector3d(stretch.value, stretch.rate, stretch.acceleration).head(size));
  };
  generator.start = setting_of(all.front());
  for (std::size_t i = 1; i < all.size(); ++i) {
    generator.times.push_back(all[i].start);
    generator.settings.push_back(setting_of(all[i]));
  }
  return generator;
}

}  // namespace gearlash::drive
