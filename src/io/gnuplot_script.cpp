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

std::string heading(const std::string& title, const std::string& subtitle) {
  return "set encoding utf8\nset title " + quoted(title, "/:Bold") + " offset 0,1.1\nset label 1 " +
         quoted(subtitle, "/*0.87") +
         " at graph 0.5, screen 0.905 center\n"
         "set tmargin screen 0.88\nset rmargin screen 0.97\n"
         "set tics nomirror out\nset border linewidth 0.8\n";
}

std::string axis_commands(char name, const ChartAxis& axis) {
  const auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.7g}", *value) : "*";
  };
  std::string text = fmt::format("set {}label {}\n", name, quoted(axis.label));
  text += fmt::format("set {}range [{}:{}]\n", name, end(axis.low), end(axis.high));
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  if (axis.tics.empty()) return text;
  text += fmt::format("set {}tics (", name);
  for (std::size_t i = 0; i < axis.tics.size(); ++i) {
    text += fmt::format("{}{} {:.7g}", i == 0 ? "" : ", ", quoted(axis.tics[i].first),
                        axis.tics[i].second);
  }
  return text + ")\n";
}

std::string plot_command(const std::vector<std::string>& layers) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < layers.size(); ++i) {
    command += (i == 0 ? "" : ", \\\n     ") + layers[i];
  }
  return command + "\n";
}

}  // namespace gearlash
