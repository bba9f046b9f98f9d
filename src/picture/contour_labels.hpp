// The numbers on the contours of a map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/paper.hpp"

namespace gearlash {

/// A number that stands in a gap of its contour and follows its direction.
struct ContourLabel {
  std::string text = {};
  PaperPoint centre = {};
  double slope = 0.0;  ///< degrees, in (−90, 90]
};

/// The size of a picture's letters on paper.
struct LetterSize {
  double width = 0.0;
  double height = 0.0;
};

/// Finds places for numbers one by one: where a contour is straight and far from the edges, the
/// given lines and the earlier numbers.
class LabelPlacer {
 public:
  LabelPlacer(std::vector<PaperLine> lines, LetterSize letter)
      : lines_(std::move(lines)), letter_(letter) {}

  struct Labelled {
    std::optional<ContourLabel> label;  ///< nothing if there is no good place
    std::vector<PaperLine> pieces;      ///< the contour without the gap
  };
  Labelled place(const PaperLine& contour, const std::string& text);

 private:
  double clearance(const PaperPoint& centre, const PaperLine& contour, double half_width) const;

  std::vector<PaperLine> lines_;
  LetterSize letter_;
  std::vector<PaperPoint> taken_;
};

}  // namespace gearlash
