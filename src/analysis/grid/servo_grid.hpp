// How many drives are worked out: what tolerance studies say of threads, vector units and progress.
#pragma once

#include <cstddef>
#include <functional>

#include "closed_form/lanes/cycle_batch.hpp"

namespace gearlash {

/// Heard from one thread at a time, now and then, with the number of things done; false stops.
struct GridEvaluation {
  std::size_t threads = 0;  ///< 0: as many as the machine has cores
  VectorUnit unit = widest_vector_unit();
  std::function<bool(std::size_t done)> going_on = {};
};

}  // namespace gearlash
