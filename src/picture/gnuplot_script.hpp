// The parts of gnuplot scripts that all pictures share.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "picture/line_chart.hpp"

namespace gearlash {

/// gnuplot text in single quotes, wholly within `style` if there is one. Nothing in the text ends
/// the quotes or is taken for markup, but that the n of ω_n and the L of J_L are set low.
std::string quoted(const std::string& text, const std::string& style = "");

/// The kind of picture, its size, and the share of its height that axis and legend take. `height`
/// is in units of 1/900 of the width.
std::string terminal(PictureFormat format, double height = 700.0);

/// Title and subtitle, in two lines where it is long, and the borders that every chart has.
std::string heading(const std::string& title, const std::string& subtitle);

struct Legend {
  std::string commands;
  double bottom;  ///< where the axes end above it, a share of the picture's height
};
/// Of these names below the axes, in as many columns as the longest permits. Letters are `scale`
/// times as large as the picture's.
Legend legend_below(const std::vector<std::string>& names, PictureFormat format,
                    double scale = 1.0);

/// Name is 'x' or 'y'.
std::string axis_commands(char name, const ChartAxis& axis);

/// "plot" with its layers, the first one lowest.
std::string plot_command(const std::vector<std::string>& layers);

/// Named data of a script, rows of numbers; blank lines part the pieces of a curve.
class DataBlock {
 public:
  explicit DataBlock(std::string name) : name_(std::move(name)) {}

  template <class... Numbers>
  void row(Numbers... numbers) {
    ((text_ += fmt::format("{:.7g} ", numbers)), ...);
    text_ += '\n';
    is_empty_ = false;
  }
  void gap() { text_ += '\n'; }

  bool is_empty() const { return is_empty_; }
  std::string text() const { return "$" + name_ + " << EOD\n" + text_ + "EOD\n"; }

 private:
  std::string name_;
  std::string text_;
  bool is_empty_ = true;
};

}  // namespace gearlash
