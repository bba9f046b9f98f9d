// The style and the parts that both pictures of a motion share.
#pragma once

#include <string>
#include <utility>

#include "base/extent.hpp"
#include "picture/drawn_motion.hpp"
#include "picture/gnuplot_script.hpp"
#include "picture/motion_picture.hpp"

namespace gearlash {

// Colours that colour-blind readers distinguish (Okabe and Ito) and that differ in grey. Dashes and
// widths repeat the distinction.
inline constexpr char load_colour[] = "#0072b2";
inline constexpr char motor_colour[] = "#d55e00";

/// The range of an axis: with a margin, as a share of the extent, and never empty.
Bounds widened(const Bounds& extent, double margin);

/// Marks of impacts; an impact that would cover the one before it is left out.
class ImpactMarks {
 public:
  ImpactMarks(std::string name, double x_extent, double y_extent)
      : marks_(std::move(name)), x_extent_(x_extent), y_extent_(y_extent) {}

  /// `other`: a third column, for another ordinate.
  void add(double x, double y, double other = 0.0);
  const DataBlock& block() const { return marks_; }

 private:
  DataBlock marks_;
  double x_extent_;
  double y_extent_;
  double x_ = std::numeric_limits<double>::infinity();
  double y_ = std::numeric_limits<double>::infinity();
};

/// The curves of one motion of the picture. Throws InvalidInput if there are too many to read.
std::vector<DrawnPiece> legible_curve(const MotionPicture& picture, const Motion& motion);

/// The drive in one line: "backlash 10 arcmin, sensor on the load, …".
std::string numbers_line(const MotionPicture& picture);

}  // namespace gearlash
