// What the core replies, but for pictures. records/make gives web/page the same as types.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/parameter.hpp"
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

struct AnswerReply {
  Level level = Level::fine;         ///< coarse: without proofs and borders
  Means means = Means::closed_form;  ///< how the answer was found
  bool is_complete = true;           ///< not stopped
  std::string headline{};            ///< the answer in one line
  std::string report{};              ///< in full; empty of a coarse answer
  Answer answer{};                   ///< its numbers
  std::string unit{};                ///< of angles
  double unit_in_si = 1.0;           ///< its size
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
