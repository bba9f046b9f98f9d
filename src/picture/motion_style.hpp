// What both pictures of a motion share.
#pragma once

#include <string>
#include <utility>

#include "base/extent.hpp"
#include "picture/drawn_motion.hpp"
#include "picture/gnuplot_script.hpp"
#include "picture/motion_picture.hpp"

namespace gearlash {

// Colours that the colour-blind tell apart (Okabe and Ito) and that differ in grey; dashes and
// widths say the same once more.
inline constexpr char load_colour[] = "#0072b2";
inline constexpr char motor_colour[] = "#d55e00";

/// The extent of an axis as gnuplot wants it: with a margin, and never empty.
std::string range_of(const Bounds& extent, double margin = 0.05);

/// Impacts, each unless it would cover the one before it.
class ImpactMarks {
 public:
  ImpactMarks(std::string name, double x_extent, double y_extent)
      : marks_(std::move(name)), x_extent_(x_extent), y_extent_(y_extent) {}

  void add(double x, double y);
  const DataBlock& block() const { return marks_; }

 private:
  DataBlock marks_;
  double x_extent_;
  double y_extent_;
  double x_ = std::numeric_limits<double>::infinity();
  double y_ = std::numeric_limits<double>::infinity();
};

/// Curves of a motion of the picture. Throws InvalidInput where they could not be read.
std::vector<DrawnPiece> legible_curve(const MotionPicture& picture, const Motion& motion);

/// "backlash 10 arcmin, sensor on the load, …": what the drive is.
std::string numbers_line(const MotionPicture& picture);

}  // namespace gearlash
