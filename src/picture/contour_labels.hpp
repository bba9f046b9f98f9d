// The numbers on the contours of a map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/paper.hpp"

namespace gearlash {

/// A number in a gap of its contour, along the contour.
struct ContourLabel {
  std::string text = {};
  PaperPoint centre = {};
  double slope = 0.0;  ///< degrees, above −90 and at most 90
};

/// Lengths on paper of the letters of a picture.
struct LetterSize {
  double width = 0.0;
  double height = 0.0;
};

/// Finds places for numbers one after the other: where a contour is straight, away from the edges,
/// from the lines given and from the numbers before.
class LabelPlacer {
 public:
  LabelPlacer(std::vector<PaperLine> lines, LetterSize letter)
      : lines_(std::move(lines)), letter_(letter) {}

  struct Labelled {
    std::optional<ContourLabel> label;  ///< nothing where there is no good place
    std::vector<PaperLine> pieces;      ///< the contour but for the gap
  };
  Labelled place(const PaperLine& contour, const std::string& text);

 private:
  double clearance(const PaperPoint& centre, const PaperLine& contour, double half_width) const;

  std::vector<PaperLine> lines_;
  LetterSize letter_;
  std::vector<PaperPoint> taken_;
};

}  // namespace gearlash
