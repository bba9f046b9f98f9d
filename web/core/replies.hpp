// What the core replies. records/make gives web/page the same as types.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/plot.hpp"
#include "output/json_writer.hpp"

namespace gearlash::web {

struct ShownFault {
  std::string path{};         ///< as of Fault
  bool is_parameter = false;  ///< whether the path is that of a parameter, which can be typed
  std::string value{};        ///< the value found; empty if it is missing
  std::string permitted{};    ///< what is permitted
  std::string where{};        ///< the place in a file, or empty
};

/// Where a slider runs.
struct Slider {
  double low = 0.0;             ///< its least value
  double high = 0.0;            ///< its greatest
  bool is_logarithmic = false;  ///< by ratio
};

struct ParameterReply {
  std::string_view path{};                     ///< as in files
  ParameterKind kind = ParameterKind::number;  ///< what its value is
  std::string_view meaning{};                  ///< one sentence, without a full stop
  ParameterValue value{};                      ///< in SI
  bool is_default = false;                     ///< whether it has its default value
  bool is_usual = false;                       ///< whether a designer considers it first
  bool is_required = false;                    ///< whether a file must give it
  std::vector<std::string_view> choices{};     ///< of a word
  std::string unit{};                          ///< in which it is shown; empty without
  double unit_in_si = 1.0;                     ///< its size
  std::optional<Slider> slider{};              ///< of a number
};

/// A section that the drive could have too.
struct AbsentSection {
  std::string_view name{};      ///< as in files
  std::string_view contents{};  ///< what is in it
};

/// Input that was bad.
struct FaultsReply {
  std::vector<ShownFault> faults{};  ///< each of them
};

/// Work that could not be done.
struct FailureReply {
  std::string failure{};  ///< why
};

struct FileReply {
  std::string toml{};  ///< of a drive, which reads back exactly
};

struct DriveReply {
  std::vector<ParameterReply> parameters{};  ///< all of them, in the order of files
  std::vector<AbsentSection> absent{};       ///< what else it could have
  bool is_normal_form = false;               ///< whether it is given as the servo of 1960
  bool is_searched = false;                  ///< whether its motions are found by a search
};

enum class Level : std::uint8_t { coarse, fine };

enum class Means : std::uint8_t { closed_form, proof_by_energy, followed, one_start, search };
/// The enumerator's name with spaces.
const char* name_of(Means means);

/// A moment at which the mode changes.
struct ShownEvent {
  double time = 0.0;         ///< in the motion's unit
  std::string what{};        ///< happened
  std::string mode_after{};  ///< "apart"; empty in contact
};

/// A motion over time. Positions are in the answer's unit, from the reference.
struct ShownMotion {
  std::string name{};                ///< among the motions of an answer
  std::string reason{};              ///< why it is not drawn; empty if it is
  std::string time_unit{};           ///< "s", or "1/ω_n" of a normal form without it
  double gap = 0.0;                  ///< face to face
  MapCurve load{};                   ///< time and position
  MapCurve motor{};                  ///< at the same times
  std::vector<ShownEvent> events{};  ///< in their order
  Plot plot{};                       ///< of positions, gap and torque
};

struct AnswerReply {
  Level level = Level::fine;         ///< coarse: without proofs and borders
  Means means = Means::closed_form;  ///< how the answer was found
  bool is_complete = true;           ///< not stopped
  std::string headline{};            ///< the answer in one line
  std::string report{};              ///< in full; empty of a coarse answer
  Answer answer{};                   ///< its numbers
  std::string unit{};                ///< of angles
  double unit_in_si = 1.0;           ///< its size
  /// The way there, and each cycle; none without a motion.
  std::vector<ShownMotion> motions{};
  std::optional<Plot> phase{};  ///< the phase plane
};

/// An axis with its drawn unit, for placing a mark.
struct DrawnAxis {
  std::string path{};       ///< of its parameter
  double unit_in_si = 1.0;  ///< the unit that is drawn
};

struct PictureReply {
  Plot plot{};                   ///< of the kind asked for
  std::optional<DrawnAxis> x{};  ///< to the right, if it is a parameter
  std::optional<DrawnAxis> y{};  ///< upwards, or of the curves, likewise
  bool is_complete = true;       ///< not stopped
};

/// A margin as a reader has it. Values beyond which hunting ends or begins are rounded to that
/// side.
struct MarginText {
  std::string parameter{};             ///< its path
  std::string description{};           ///< what it is
  bool is_setting = false;             ///< whether it is one of the drive, which can be set
  bool is_certified = false;           ///< whether the margin is proved
  std::string present{};               ///< its value; empty if it is not given
  std::optional<std::string> below{};  ///< where hunting ends or begins
  std::optional<std::string> above{};  ///< likewise
  std::string searched{};              ///< the range
  std::vector<std::string> choices{};  ///< of a word: those with which it ends or begins
};

struct MarginsReply {
  bool hunts = false;               ///< at present
  bool is_known = true;             ///< whether that is known
  bool is_complete = true;          ///< not stopped
  std::vector<MarginText> texts{};  ///< of each parameter
};

}  // namespace gearlash::web
