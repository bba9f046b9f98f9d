// The style and the parts that both pictures of a motion share.
#pragma once

#include <string>
#include <vector>

#include "picture/drawn_motion.hpp"
#include "picture/motion_picture.hpp"

namespace gearlash {

/// Marks of impacts; an impact that would cover the one before it is left out.
class ImpactMarks {
 public:
  /// The extents of the axes.
  ImpactMarks(double x_extent, double y_extent) : x_extent_(x_extent), y_extent_(y_extent) {}

  void add(const MapPoint& point);
  /// Adds them to the panel if there are any.
  void draw(double size, Panel& panel) const;

 private:
  double x_extent_;
  double y_extent_;
  MapCurve marks_;
};

/// The curves of one motion of the picture. Throws InvalidInput if there are too many to read.
std::vector<DrawnPiece> legible_curve(const MotionPicture& picture, const Motion& motion);

/// The drive in one line: "backlash 10 arcmin, sensor on the load, …".
std::string numbers_line(const MotionPicture& picture);

}  // namespace gearlash
