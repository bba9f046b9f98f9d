// Drawing any plot through gnuplot.
#pragma once

#include <string>

#include "picture/picture.hpp"
#include "picture/plot.hpp"

namespace gearlash {

/// Returns the bytes of the picture; the same plot gives the same SVG. Throws OutputError if
/// gnuplot is missing or fails.
std::string draw(const Plot& plot, PictureFormat format);

}  // namespace gearlash
