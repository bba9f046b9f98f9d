// Points of a panel in pixels, so that straightness, distance and slope are those seen.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "picture/plot_making.hpp"

namespace gearlash {

/// Pixels to the right of and above the lower left corner of the axes.
using PaperPoint = std::complex<double>;
using PaperLine = std::vector<PaperPoint>;

/// The rectangle between the axes of a panel that is panel_width wide.
class Paper {
 public:
  /// Precondition: both axes have their ends.
  explicit Paper(const Panel& panel)
      : x_(span_of(panel.x)), y_(span_of(panel.y)), height_(panel.height) {}

  double height() const { return height_; }
  /// Whether a place is on it; `margin` in pixels.
  bool holds(const PaperPoint& place, double margin = 0.0) const {
    return place.real() >= -margin && place.real() <= panel_width + margin &&
           place.imag() >= -margin && place.imag() <= height_ + margin;
  }
  PaperPoint on_paper(const MapPoint& point) const;
  MapPoint on_map(const PaperPoint& point) const;
  PaperLine on_paper(const MapCurve& curve) const;
  MapCurve on_map(const PaperLine& line) const;

 private:
  Axis x_;
  Axis y_;
  double height_;
};

double length_of(const PaperLine& line);

/// Of a closed line, positive if it runs counterclockwise.
double area_within(const PaperLine& line);

/// The line reduced to few of its points: by less than is visible (Douglas and Peucker, 1973).
PaperLine thinned(const PaperLine& line);

/// Finds places for texts where they cover neither the lines nor each other.
class TextPlacer {
 public:
  TextPlacer(std::vector<PaperLine> lines, double height)
      : lines_(std::move(lines)), height_(height) {}

  /// The center of a text beside a point, in letters of this size. Nothing if there is no free
  /// place, unless `must` is set.
  std::optional<PaperPoint> beside(const PaperPoint& point, const std::string& text, double size,
                                   bool must);

  /// A place for a text in a gap of the line, where that is straight and far from all else.
  struct InLine {
    PaperPoint centre;
    double slope;                  ///< degrees, in (−90, 90]
    std::vector<PaperLine> parts;  ///< the line without the gap
  };
  /// Nothing if there is no good place.
  std::optional<InLine> along(const PaperLine& line, const std::string& text, double size);

 private:
  /// A place for a text, from its centre to its end; better with more merit, in pixels.
  struct Spot {
    PaperPoint centre;
    PaperPoint half;
    double merit;
  };
  /// Points along the middle of a text.
  static PaperLine middle_of(const Spot& spot);
  /// The best spot that touches nothing, or the best of all if it `must` be; it is taken. Room
  /// beyond `enough` pixels counts no more.
  std::optional<std::size_t> take_best(const std::vector<Spot>& spots, double enough, bool must,
                                       const PaperLine* own);
  /// To the nearest edge, text or line other than `own`; negative if it would touch.
  double clearance(const Spot& spot, const PaperLine* own) const;

  std::vector<PaperLine> lines_;
  double height_;
  std::vector<PaperPoint> taken_;
};

}  // namespace gearlash
