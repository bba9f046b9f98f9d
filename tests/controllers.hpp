// Controllers of reduced drives, by laws whose gains are those at the load's shaft.
#pragma once

#include "base/number.hpp"
#include "model/controller_forms.hpp"

namespace gearlash {

template <class Law>
drive::LinearController at_load(const Law& law) {
  return drive::forms::linear(law, AsRead(), 1.0);
}

}  // namespace gearlash
