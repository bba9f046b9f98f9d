// Sums and multiples of affine forms.
#pragma once

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

inline AffineForm operator+(const AffineForm& a, const AffineForm& b) {
  return {a.normal + b.normal, a.offset + b.offset};
}
inline AffineForm operator-(const AffineForm& a, const AffineForm& b) {
  return {a.normal - b.normal, a.offset - b.offset};
}
inline AffineForm operator*(double factor, const AffineForm& form) {
  return {factor * form.normal, factor * form.offset};
}
inline AffineForm operator+(const AffineForm& form, double constant) {
  return {form.normal, form.offset + constant};
}
inline AffineForm operator-(const AffineForm& form, double constant) { return form + (-constant); }

}  // namespace gearlash::hybrid
