// What a picture in SVG shows: its text, how often a part of it, and the strokes of one colour.
#pragma once

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace gearlash::test {

/// What a reader sees: the text between the tags.
inline std::string visible_text(const std::string& svg) {
  std::string text;
  bool inside_tag = false;
  for (const char c : svg) {
    if (c == '<') inside_tag = true;
    if (!inside_tag) text += c;
    if (c == '>') inside_tag = false;
  }
  return text;
}

inline std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

/// From one point of a path to the next, in pixels to the right and down.
struct Stroke {
  bool is_drawn = false;  ///< else the pen is moved
  double from_right, from_down, right, down;
};

/// Of all paths whose tag has this text, as "stroke='rgb( 85,  85,  85)'".
inline std::vector<Stroke> strokes_of(const std::string& svg, const std::string& colour) {
  std::vector<Stroke> strokes;
  for (std::size_t place = svg.find(colour); place != std::string::npos;
       place = svg.find(colour, place + 1)) {
    const std::size_t begin = svg.find(" d='M", place) + 5;
    std::istringstream path(svg.substr(begin, svg.find('\'', begin) - begin));
    char separator = ' ';
    double right = 0.0;
    double down = 0.0;
    path >> right >> separator >> down;
    for (char command = ' '; path >> command;) {
      const double last_right = right;
      const double last_down = down;
      path >> right >> separator >> down;
      strokes.push_back({command == 'L', last_right, last_down, right, down});
    }
  }
  return strokes;
}

}  // namespace gearlash::test
