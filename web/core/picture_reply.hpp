// Pictures as the page draws them: curves as columns of numbers, with their meaning.
#pragma once

#include "numbers.hpp"
#include "picture/contour_map.hpp"
#include "picture/line_chart.hpp"
#include "picture/motion_picture.hpp"

namespace gearlash::web {

/// Motions, each as columns of time, positions, speeds, torque, reference and, with an encoder, its
/// reading, and as pieces between events. A motion with too many events to draw has a reason
/// instead.
Json motion_picture_json(const MotionPicture& picture, Numbers& numbers);

/// Curves are columns of x and y by turns.
Json contour_map_json(const ContourMap& map, Numbers& numbers);

Json line_chart_json(const LineChart& chart, Numbers& numbers);

}  // namespace gearlash::web
