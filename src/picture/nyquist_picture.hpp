// The classical describing-function picture: loop gain and −1/N.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/plot.hpp"
#include "gearlash/units.hpp"
#include "output/describe_report.hpp"
#include "question/loop/describing/describing.hpp"

namespace gearlash {

struct NyquistPicture {
  std::string title = {};  ///< one line
  /// Nonlinearities in the same loop, which is drawn once. At least one; all are drawn.
  std::vector<drive::DescribingAnalysis> analyses = {};
  std::vector<drive::ExactMotion> exact = {};  ///< stable ones of known period are drawn
  AngleUnit angle = {};
  bool is_normalized = false;  ///< times are in units of 1/ω_n, frequencies are ω
};

/// The analyses of this part; for a gap those of both kinds of load. Empty if the part is in no
/// loop.
std::vector<drive::DescribingAnalysis> loop_analyses(
    const std::vector<drive::DescribingAnalysis>& analyses, drive::DescribedPart part);

/// The words for parts: "gap", "relay", ….
std::vector<std::string> parts_to_draw();

/// The part of that name, else the first one in a loop. Throws InvalidInput where there is none.
Plot nyquist_plot(const DescribeReport& report, std::string_view part);

/// L(jω) with marks of frequency, and −1/N(A) with marks of amplitude and an arrow towards
/// growing A. Cycles lie where the curves meet (stable: full circles, unstable: open). Each exact
/// cycle has two points, L(jω) and −1/N(A), with its motor's motion taken for a sine; they would
/// coincide if the method were exact. Real and imaginary parts have the same scale. The window
/// shows the stable cycles and the exact points; unstable cycles outside it appear only in the
/// legend.
Plot nyquist_plot(const NyquistPicture& picture);

}  // namespace gearlash
