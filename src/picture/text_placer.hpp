// Placing texts beside points of a picture.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gearlash {

/// Places texts beside their points where they cover least of the curves, marks and other texts.
/// Lengths are in heights of the frame, whose width is `aspect`; `letter` is the mean width of a
/// letter.
class TextPlacer {
 public:
  TextPlacer(std::vector<std::complex<double>> obstacles, double letter, double aspect)
      : obstacles_(std::move(obstacles)), letter_(letter), aspect_(aspect) {}

  /// The center of the text. Nothing if the text would cover another one, unless `must` is set.
  std::optional<std::complex<double>> place(const std::complex<double>& point,
                                            const std::string& text, bool must);

 private:
  struct Box {
    std::complex<double> center;
    double half_width;
    double half_height;
  };

  static bool overlap(const Box& a, const Box& b);
  Box beside(const std::complex<double>& point, double direction, double distance,
             double width) const;
  double cost_of(const Box& box) const;

  std::vector<std::complex<double>> obstacles_;
  std::vector<Box> taken_;
  double letter_;
  double aspect_;
};

}  // namespace gearlash
