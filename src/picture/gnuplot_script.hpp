// The parts of gnuplot scripts that all pictures share.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "picture/line_chart.hpp"

namespace gearlash {

/// gnuplot text in single quotes, all of it in `style` if one is given. Quotes and markup in the
/// text are escaped; only subscripts such as those of ω_n and J_L are set low.
std::string quoted(const std::string& text, const std::string& style = "");

/// The kind and size of the picture and the share of its height for axis and legend. `height` is in
/// units of 1/900 of the width.
std::string terminal(PictureFormat format, double height = 700.0);

/// Letters in a line of a title, and in one of a subtitle.
inline constexpr std::size_t page_in_bold = 84;
inline constexpr std::size_t page_in_small = 112;

/// The text in one line, or in two if it has more than `width` columns, broken after a semicolon, a
/// comma or a blank.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

/// The smallest step of 1, 2 or 5 times a power of ten that divides `length` into at most `most`.
double round_step(double length, int most);

/// Title and subtitle (each in two lines if it is long), and the borders of every chart.
std::string heading(const std::string& title, const std::string& subtitle);

struct Legend {
  std::string commands;
  double bottom;  ///< lower end of the axes above it, as a share of the picture's height
};
/// A legend of these names below the axes, in as many columns as the longest name permits. Letters
/// are `scale` times as large as the picture's.
Legend legend_below(const std::vector<std::string>& names, PictureFormat format,
                    double scale = 1.0);

/// `name` is 'x' or 'y'.
std::string axis_commands(char name, const ChartAxis& axis);

/// The "plot" command of the layers, the first one lowest.
std::string plot_command(const std::vector<std::string>& layers);

/// Named data of a script: rows of numbers; blank lines separate the parts of a curve.
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
  const std::string& name() const { return name_; }
  std::string text() const { return "$" + name_ + " << EOD\n" + text_ + "EOD\n"; }

 private:
  std::string name_;
  std::string text_;
  bool is_empty_ = true;
};

}  // namespace gearlash
