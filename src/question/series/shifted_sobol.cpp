#include "question/series/shifted_sobol.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <random>

namespace gearlash::detail {

struct ShiftedSobol::Sequence : boost::random::sobol {
  using boost::random::sobol::sobol;
};

ShiftedSobol::ShiftedSobol(std::size_t dimensions, const SamplePlan& sampling)
    : dimensions_(dimensions),
      sequence_(std::make_shared<const Sequence>(std::max<std::size_t>(dimensions, 1))) {
  static_assert(boost::random::sobol::max() == ~std::uint64_t{0});
  std::mt19937_64 bits(sampling.seed);
  shifts_.resize(sampling.replicates * dimensions);
  for (std::uint64_t& shift : shifts_) shift = bits();
}

void ShiftedSobol::fill(std::size_t replicate, std::size_t first,
                        std::span<double> coordinates) const {
  if (dimensions_ == 0) return;
  const std::uint64_t* shifts = shifts_.data() + replicate * dimensions_;
  const auto coordinate = [](std::uint64_t bits) {
    return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
  };
  std::size_t place = 0;
  boost::random::sobol sequence = *sequence_;
  if (first == 0) {  // Boost begins after the origin
    for (; place < std::min(dimensions_, coordinates.size()); ++place) {
      coordinates[place] = coordinate(shifts[place]);
    }
  } else {
    sequence.seed(first - 1);
  }
  for (std::size_t dimension = 0; place < coordinates.size(); ++place) {
    coordinates[place] = coordinate(sequence() ^ shifts[dimension]);
    if (++dimension == dimensions_) dimension = 0;
  }
}

}  // namespace gearlash::detail
