#include "gnuplot_script.hpp"

#include <cctype>
#include <string_view>

namespace gearlash {
namespace {

/// How many letters from `place` on are a subscript: "n" after "ω_", or what follows a capital that
/// stands by itself and "_", as in J_L and F_Total. None in names such as "my_servo".
std::size_t subscript_length(const std::string& text, std::size_t place) {
  const auto is_letter = [&](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  if (place < 2 || text[place - 1] != '_') return 0;
  const bool after_omega = text.substr(0, place - 1).ends_with("ω");
  const bool after_capital = std::isupper(static_cast<unsigned char>(text[place - 2])) != 0 &&
                             (place == 2 || (text[place - 3] != '_' && !is_letter(place - 3)));
  if (!after_omega && !after_capital) return 0;
  std::size_t length = 0;
  while (is_letter(place + length)) ++length;
  return length;
}

}  // namespace

std::string quoted(const std::string& text, const std::string& style) {
  std::string safe = style.empty() ? "'" : "'{" + style + " ";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) < 0x20) continue;
    if (const std::size_t length = subscript_length(text, i + 1); c == '_' && length > 0) {
      safe += "_{" + text.substr(i + 1, length) + "}";
      i += length;
      continue;
    }
    if (std::string_view("\\_^{}@&~").find(c) != std::string_view::npos) safe += '\\';
    safe += c;
    if (c == '\'') safe += c;
  }
  return safe + (style.empty() ? "'" : "}'");
}

const char* terminal(PictureFormat format) {
  switch (format) {
    case PictureFormat::svg:
      return "set terminal svg enhanced size 900,700 font 'sans-serif,15' background rgb 'white' "
             "linewidth 1.2\nset bmargin screen 0.25\n";
    case PictureFormat::png:
      return "set terminal pngcairo enhanced size 1800,1400 font 'sans-serif,22' linewidth 2.4 "
             "dashlength 1.4 pointscale 2\nset bmargin screen 0.21\n";
    case PictureFormat::pdf:
      return "set terminal pdfcairo enhanced size 18cm,14cm font 'sans-serif,11' linewidth 1.2\n"
             "set bmargin screen 0.21\n";
  }
  return "";
}

std::string plot_command(const std::vector<std::string>& layers) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < layers.size(); ++i) {
    command += (i == 0 ? "" : ", \\\n     ") + layers[i];
  }
  return command + "\n";
}

}  // namespace gearlash
