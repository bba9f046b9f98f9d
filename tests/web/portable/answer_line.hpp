// Writes one line of the output: see portable_answers.hpp.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

namespace gearlash::portable {

/// The distance from 1 to the next double.
inline constexpr double ulp = 0x1p-52;

class AnswerLine {
 public:
  AnswerLine(std::string_view kind, std::string_view name) : text_(kind) {
    text_.append(" ").append(name);
  }
  AnswerLine(const AnswerLine&) = delete;
  AnswerLine& operator=(const AnswerLine&) = delete;
  ~AnswerLine() { std::puts(text_.c_str()); }

  /// A word; spaces become hyphens.
  AnswerLine& word(std::string_view key, std::string value) {
    for (char& letter : value) {
      if (letter == ' ') letter = '-';
    }
    text_.append(" ").append(key).append("=").append(value);
    return *this;
  }
  AnswerLine& number(std::string_view key, double value) { return word(key, exact(value)); }
  AnswerLine& number(std::string_view key, double value, double unit) {
    return word(key, exact(value) + "~" + exact(unit));
  }

 private:
  static std::string exact(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%a", value);
    return text;
  }

  std::string text_;
};

/// A fixed point of a map moves by error/(1 − slope) when the map errs; the cycle is one of the map
/// over a period, whose largest slope is the multiplier.
inline double condition_of_cycle(double multiplier) {
  return 1.0 + 1.0 / std::abs(1.0 - multiplier);
}

}  // namespace gearlash::portable
