// Pictures: what is drawn of a drive, of its motion and of a production run, and files of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/motion.hpp"
#include "gearlash/plot.hpp"
#include "gearlash/progress.hpp"
#include "gearlash/quantity.hpp"
#include "gearlash/tolerance.hpp"

namespace gearlash {

/// What a picture of a drive shows.
enum class PictureKind : std::uint8_t {
  phase,         ///< the limit cycles in the phase plane, and motions that lead to them
  time,          ///< such a motion over time
  ceiling,       ///< what the proved bound of every motion is made of
  tornado,       ///< the sensitivities of the amplitude
  nyquist,       ///< the loop's gain against −1/N of a describing function
  curves,        ///< a quantity over the last axis, a curve for each value of the one before
  map,           ///< regions and contours of a quantity over two axes, the first upwards
  bifurcation,   ///< cycles over an axis, with their borders
  comparison,    ///< step responses, one for each value of an axis
  distribution,  ///< the amplitudes of a production run
  yield,         ///< the share of its samples up to an amplitude
  indices        ///< what decides its amplitudes
};

/// A picture of one drive.
struct PictureQuestion {
  PictureKind kind = PictureKind::phase;  ///< what is shown
  Drive drive{};                          ///< of which it is
  std::string angle{};                    ///< unit of angles: "deg", …; empty: the drive\'s own
  /// Of curves one or two, of a map two, of a bifurcation one; of a comparison one, or none for the
  /// places of the sensor.
  std::vector<Axis> axes{};
  Quantity quantity = Quantity::amplitude;   ///< of curves, a map and a bifurcation
  bool marks_drive = true;                   ///< a map shows where the drive itself lies
  std::string target{};                      ///< of a map: "amplitude <= 3 arcmin"; empty: none
  std::string part{};                        ///< of nyquist: "gap", "relay", …; empty: the first
  std::vector<ParameterTolerance> varied{};  ///< of a production run
};

/// Finds what the picture shows, and makes it. Throws InvalidInput for a faulty drive, axes, unit
/// or target, and where there is nothing to draw.
[[nodiscard]] Plot picture_of(const PictureQuestion& question, Progress& progress = no_progress());

/// A motion of the drive over time: positions of both shafts with the reference and the gap, the
/// gap between the faces, and the torque; if its end would be lost there, that alone beside it.
/// Throws InvalidInput for another unit than one of angles, and for a motion with more events or
/// periods than can be read.
[[nodiscard]] Plot time_plot(const Drive& drive, const Motion& motion,
                             const std::string& angle = "");

/// The same motion in the phase plane, from a time on (s).
[[nodiscard]] Plot phase_plot(const Drive& drive, const Motion& motion,
                              const std::string& angle = "", double from = 0.0);

/// The distribution or the yield of a production run. Throws InvalidInput where no sample hunts.
[[nodiscard]] Plot tolerance_plot(PictureKind kind, const ToleranceStudy& study,
                                  const std::string& angle = "rad");

/// Each tolerance's share of the amplitude's variance, the largest on top. Throws InvalidInput
/// where no sample hunts.
[[nodiscard]] Plot indices_plot(const ToleranceStudy& study, const SensitivityStudy& sensitivities);

enum class PictureFormat : std::uint8_t { svg, png, pdf };

/// The bytes of a file of the plot, by gnuplot; the same plot gives the same bytes. Throws
/// std::runtime_error if gnuplot is missing or fails.
[[nodiscard]] std::string draw(const Plot& plot, PictureFormat format);

}  // namespace gearlash
