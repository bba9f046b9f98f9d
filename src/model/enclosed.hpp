// Models whose numbers are known to lie between those of given ones.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/datum.hpp"
#include "model/drive.hpp"

namespace gearlash {

/// Any number of models of one form: each number lies between the smallest and the largest of those
/// at the ends, to 64 units in the last place. One end: the model itself.
template <class Model>
class Enclosed {
 public:
  Enclosed(Model one) : ends_{std::move(one)} {}
  explicit Enclosed(std::vector<Model> ends) : ends_(std::move(ends)) {}

  /// For what all have in common.
  const Model& form() const { return ends_.front(); }
  const std::vector<Model>& ends() const { return ends_; }

  /// Contains `number(model)` of each model.
  template <class Number>
  Interval number(const Number& number) const {
    Interval result = datum(number(ends_.front()));
    for (std::size_t i = 1; i < ends_.size(); ++i) result = hull(result, datum(number(ends_[i])));
    return result;
  }
  /// What is made of each model, of which every number must be monotone in every number of it.
  template <class Make>
  auto made(const Make& make) const {
    std::vector<decltype(make(ends_.front()))> all;
    for (const Model& one : ends_) all.push_back(make(one));
    return Enclosed<decltype(make(ends_.front()))>(std::move(all));
  }
  template <class Property>
  bool any_of(const Property& property) const {
    return std::any_of(ends_.begin(), ends_.end(), property);
  }

 private:
  std::vector<Model> ends_;
};

using EnclosedDrive = Enclosed<drive::ReducedDrive>;
using EnclosedController = Enclosed<drive::LinearController>;

}  // namespace gearlash
