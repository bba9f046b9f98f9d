#include "gnuplot_script.hpp"

#include <string_view>

namespace gearlash {

std::string quoted(const std::string& text, const std::string& style) {
  std::string safe = style.empty() ? "'" : "'{" + style + " ";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) < 0x20) continue;
    if (text.compare(i, 2, "_n") == 0 && safe.ends_with("ω")) {
      safe += "_{n}";
      ++i;
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
