// The report of an answer, as text and as JSON, for both engines.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/output.hpp"
#include "gearlash/sensitivity.hpp"
#include "gearlash/units.hpp"
#include "output/parameter_text.hpp"

namespace gearlash {

/// Hunting as a user saw it.
struct MeasuredHunting {
  double amplitude = 0.0;  ///< rad, half the peak-to-peak of the load
  double frequency = 0.0;  ///< Hz
};

/// A motion on which the drive may stay, beside the measured one.
struct MotionBesideMeasured {
  std::string list{};            ///< of the answer: "cycles" or "irregular"
  std::size_t index = 0;         ///< in it
  double amplitude = 0.0;        ///< rad, of the load
  double frequency = 0.0;        ///< Hz
  double amplitude_share = 0.0;  ///< by which the measured amplitude exceeds it, as a share
  double frequency_share = 0.0;  ///< by which the measured frequency exceeds it, as a share
};

/// "gearlash/limit-cycle/3": what a drive ends in.
struct AnswerReport {
  Drive drive{};                              ///< its parameters
  Answer answer{};                            ///< what it ends in
  Provenance provenance{};                    ///< how it was made
  std::optional<HuntingMargin> margin{};      ///< on request, as is `sensitivity`
  std::optional<Jacobian> sensitivity{};      ///< derivatives, on request
  std::optional<MeasuredHunting> measured{};  ///< to be compared with every motion found

  [[nodiscard]] std::optional<double> widest_backlash()
      const;  ///< rad, that provably keeps the specification; empty where none is proved
  [[nodiscard]] std::vector<MotionBesideMeasured> beside_measured()
      const;  ///< the motions that do not fade, the nearest to the measured one first
  [[nodiscard]] std::vector<ParameterFacts> parameters()
      const;  ///< of the margins; their values of words are indices into the choices
};

/// A report without margins and sensitivities.
AnswerReport report_of(const Drive& drive, const Answer& answer, const Provenance& provenance);
/// The same, made by this version.
AnswerReport report_of(const Drive& drive, const Answer& answer);

/// Whether the motor swings within the gap and the load stands still.
bool is_of_motor_alone(const Cycle& cycle);

/// The answer in one line with its numbers: "hunts: ±0.0819 rad (4.69°) at 2.26 Hz", "cannot hunt:
/// growth at rest 0.43 < 1".
std::string headline(const AnswerReport& report);

/// How much a report has: the first 40 lines that a reader needs, or every number.
enum class Detail : unsigned char { usual, all };

/// The headline; whether the specification is met; why: energy, causes, the linear loop, the step;
/// rest, other motions, the ceiling, the search. Ends with a newline.
std::string answer_text(const AnswerReport& report, Detail detail = Detail::usual);

/// The report as JSON, in SI. Ends with a newline.
std::string answer_json(const AnswerReport& report);

}  // namespace gearlash
