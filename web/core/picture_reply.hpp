// Pictures as the page draws them: curves as columns of numbers, with their meaning.
#pragma once

#include "numbers.hpp"
#include "picture/motion_picture.hpp"
#include "picture/plot.hpp"

namespace gearlash::web {

/// Motions, each as columns of time, positions, torque, reference and, with an encoder, its
/// reading, with its events. A motion with too many of them to draw has a reason instead.
Json motion_picture_json(const MotionPicture& picture, Numbers& numbers);

/// Points are columns of x and y by turns.
Json plot_json(const Plot& plot, Numbers& numbers);

}  // namespace gearlash::web
