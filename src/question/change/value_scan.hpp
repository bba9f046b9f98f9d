// Tries values of one parameter, denser near a limit, and closes in on where a target ends.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "question/change/target.hpp"
#include "question/family/analysed_line.hpp"

namespace gearlash {

/// Whether a drive meets its target with one value of a parameter, and by how much.
struct JudgedValue {
  double value = 0.0;
  bool is_met = false;
  bool is_known = true;
  bool moves = false;          ///< it does not always come to rest
  double beyond = 0.0;         ///< excess()
  double beyond_limits = 0.0;  ///< excess() of the limits alone
};

/// Judges a value; from several threads at a time if values are tried side by side.
using Judge = std::function<JudgedValue(double value)>;

/// The drives along a line, judged by a target; from several threads at a time.
class JudgedLine {
 public:
  /// `analyse`: the answers' source, AnalysedLine::Analyse or what must be known for a search. The
  /// target must outlive it.
  template <class Source>
  JudgedLine(const DriveAlong& drive, const Source& analyse, std::size_t usual,
             const Target& target, Progress& progress)
      : line_(drive, analyse, usual, progress), target_(target) {}

  JudgedValue afresh(double value) { return judged(value, line_.afresh(value)); }
  /// From the nearest value that is known.
  JudgedValue followed(double value) {
    return judged(value, line_.followed(value, line_.nearest(value)));
  }
  /// Without an analysis the drive is unsound, or the work was stopped.
  JudgedValue judged(double value, const AnalysedLine::Known& analysis) const;

  const Target& target() const { return target_; }
  AnalysedLine& line() { return line_; }
  const AnalysedLine& line() const { return line_; }

 private:
  AnalysedLine line_;
  const Target& target_;
};

/// A part of the range and its judgement.
struct Part {
  Bounds values;
  Judgement judgement;
  /// What the drive does is not known at one of its ends, or at a value tried between them.
  bool is_unknown = false;
};

struct ScanPlan {
  int most_halvings = 6;        ///< of an interval near a limit
  int halvings_everywhere = 2;  ///< of each interval in which something moves, where motion is
                                ///< unknown somewhere: it may be irregular, with windows in it
};

/// Values side by side.
std::vector<JudgedValue> judged_values(const Judge& judge, const std::vector<double>& values);

/// `tried`, which rise, and the values tried between them, in order. Intervals are halved whose
/// ends lie on one side of a limit, and no farther from it than the motion changes there or in an
/// adjacent interval, and those next to unknown motion.
std::vector<JudgedValue> tried_between(std::vector<JudgedValue> tried, const Judge& judge,
                                       const ScanPlan& plan = {});
/// The same from values that rise.
inline std::vector<JudgedValue> tried_values(const Judge& judge, const std::vector<double>& first) {
  return tried_between(judged_values(judge, first), judge);
}

/// The parts between the values. The ends of each decide its judgement.
std::vector<Part> parts_between(const std::vector<JudgedValue>& tried);

/// The value that comes closest to the target. Precondition: there is one.
double closest_of(const std::vector<JudgedValue>& tried);

/// Relative distances to which the end of a target is located.
struct Resolution {
  double smooth = 0.0;   ///< where the target is missed by little at first
  double at_jump = 0.0;  ///< where the motion changes abruptly
  double least = 0.0;    ///< nearer values, absolutely, are one
};

/// The last value that meets the target, between one that meets it and one that does not.
struct LastMet {
  double value = 0.0;
  double first_unmet = 0.0;  ///< the nearest value tried that does not
  bool met_unknown = false;  ///< what the drive does is not known somewhere between the two
};
LastMet last_met(const Judge& judge, double met, double unmet, const Resolution& resolution);

/// Whether one of the intervals contains the value.
bool is_in(const std::vector<Bounds>& intervals, double value);

/// Adds an interval to others that end before it, or touch it.
void add(std::vector<Bounds>& intervals, const Bounds& more);

/// The middle of an interval whose ends are not negative, by ratio if it is wide.
double middle_value(double low, double high);

/// Writes the intervals that meet the target, with their ends, and what remains undecided.
/// `is_met_at` judges the ends of parts. Both functions are called from several threads at a time.
void put_together(const std::vector<Part>& parts, const std::function<bool(double)>& is_met_at,
                  const std::function<LastMet(double met, double unmet)>& last_met_between,
                  FeasibleValues& found);

}  // namespace gearlash
