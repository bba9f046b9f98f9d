#include "general/assemble/automata.hpp"

namespace gearlash::drive {

hybrid::Transition transition(const char* name, const hybrid::AffineForm& guard,
                              hybrid::Direction direction, std::size_t target) {
  hybrid::Transition result;
  result.name = name;
  result.guard = guard;
  result.direction = direction;
  result.target = target;
  return result;
}

hybrid::AffineReset stopped(const DriveForms& forms, std::initializer_list<Eigen::Index> speeds) {
  hybrid::AffineReset reset;
  reset.matrix = forms.identity();
  for (const Eigen::Index speed : speeds) reset.matrix(speed, speed) = 0.0;
  return reset;
}

}  // namespace gearlash::drive
