#include "picture/contour_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "output/columns.hpp"
#include "picture/contour_labels.hpp"
#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"
#include "picture/paper.hpp"

namespace gearlash {
namespace {

constexpr double unseen = 1.5e-3;  ///< on paper: a seventh of an SVG's pixel

constexpr double label_scale = 0.85;
constexpr double shortest_drawn = 0.35;  ///< shorter contours would be clutter

/// The size of the numbers on contours.
LetterSize letter_size(PictureFormat format) {
  const double letters_a_line = format == PictureFormat::svg   ? 54.0
                                : format == PictureFormat::png ? 75.0
                                                               : 46.0;
  return {label_scale * 0.55 * 9.0 / letters_a_line, label_scale * 9.0 / letters_a_line};
}

std::string line_style(double width, const std::string& colour) {
  return fmt::format("linewidth {} linecolor rgb '{}'", width, colour);
}
std::string boundary_style() { return line_style(3.0, "#d55e00"); }
std::string inner_boundary_style() { return line_style(1.5, "#606060") + " dashtype 2"; }
std::string mark_style() { return "pointtype 7 pointsize 1 linecolor rgb '#000000'"; }
std::string other_contour_style() { return line_style(1.0, "#7b3294") + " dashtype 3"; }
std::string hatching_style() { return line_style(0.6, "#a8a8a8"); }

/// A colour from light to dark blue.
std::string colour_of(std::size_t number, std::size_t count) {
  const double share =
      count < 2 ? 1.0 : static_cast<double>(number) / (static_cast<double>(count) - 1.0);
  const auto mixed = [&](double light, double dark) {
    return static_cast<int>(std::lround(light + share * (dark - light)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(104, 8), mixed(172, 44), mixed(214, 107));
}

void add_line(DataBlock& block, const PaperLine& line, const Paper& paper) {
  if (!block.is_empty()) block.gap();
  for (const PaperPoint& point : line) {
    const MapPoint place = paper.point_on_map(point);
    block.row(place.x, place.y);
  }
}

DataBlock curves_block(const std::string& name, const std::vector<MapCurve>& curves,
                       const Paper& paper) {
  DataBlock block(name);
  for (const MapCurve& curve : curves) {
    add_line(block, thinned(paper.line_on_paper(curve), unseen), paper);
  }
  return block;
}

std::string label_command(const ContourLabel& label, const Paper& paper) {
  const MapPoint place = paper.point_on_map(label.centre);
  return fmt::format("set label {} at {:.7g}, {:.7g} center rotate by {:.1f} front\n",
                     quoted(label.text, "/*0.85"), place.x, place.y, label.slope);
}

/// The commands and layers of the picture, bottom to top.
struct DrawnContours {
  std::string commands = {};
  std::vector<std::string> layers = {};

  void add(const DataBlock& block, const std::string& name, const std::string& style) {
    if (block.is_empty()) return;
    commands += block.text();
    layers.push_back(fmt::format("${} using 1:2 with lines {} notitle", name, style));
  }
};

/// Adds the regions, the largest outline first: what lies in a hole of one covers it.
void add_regions(const ContourMap& map, const Paper& paper, DrawnContours& drawing) {
  std::vector<std::pair<double, std::string>> layers;
  for (const ColouredRegion& region : map.regions) {
    for (const MapCurve& outline : region.outlines) {
      const double area = area_within(paper.line_on_paper(outline));
      if (!(area > 0.0)) continue;  // a hole
      const std::string name = fmt::format("region{}", layers.size());
      drawing.commands += curves_block(name, {outline}, paper).text();
      layers.emplace_back(
          area, fmt::format("${} using 1:2 with filledcurves closed fillcolor rgb '{}' fillstyle "
                            "solid noborder notitle",
                            name, region.colour));
    }
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  for (auto& [area, layer] : layers) drawing.layers.push_back(std::move(layer));
}

/// Adds the contours, with numbers in their longer parts.
void add_contours(const ContourMap& map, const Paper& paper, PictureFormat format,
                  DrawnContours& drawing) {
  std::vector<std::vector<PaperLine>> contours;
  std::vector<PaperLine> all;
  const auto keep = [&](const std::vector<MapCurve>& curves) {
    std::vector<PaperLine> lines;
    for (const MapCurve& curve : curves) {
      const PaperLine line = thinned(paper.line_on_paper(curve), unseen);
      if (length_of(line) > shortest_drawn) lines.push_back(line);
    }
    all.insert(all.end(), lines.begin(), lines.end());
    return lines;
  };
  keep(map.boundary);
  std::vector<Contour> shown = map.contours;
  shown.insert(shown.end(), map.other_contours.begin(), map.other_contours.end());
  for (const Contour& contour : shown) contours.push_back(keep(contour.curves));
  LabelPlacer placer(all, letter_size(format));
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const std::string name = fmt::format("contour{}", i);
    DataBlock block(name);
    for (const PaperLine& line : contours[i]) {
      const auto labelled = placer.place(line, fmt::format("{:.4g}", shown[i].level));
      if (labelled.label) drawing.commands += label_command(*labelled.label, paper);
      for (const PaperLine& piece : labelled.pieces) add_line(block, piece, paper);
    }
    const bool is_first_kind = i < map.contours.size();
    drawing.add(
        block, name,
        is_first_kind ? line_style(1.3, colour_of(i, map.contours.size())) : other_contour_style());
  }
}

/// A line in shares of the picture.
std::string screen_line(double from_right, double from_up, double to_right, double to_up,
                        const std::string& style) {
  return fmt::format("set arrow from screen {:.4f}, {:.4f} to screen {:.4f}, {:.4f} nohead {}\n",
                     from_right, from_up, to_right, to_up, style);
}

/// A sample of the legend.
struct LegendEntry {
  enum class Sample { line, hatching, dense_hatching, point, area } sample{};
  std::string style;  ///< of a line, or an area's colour
  std::string meaning;
};

std::vector<LegendEntry> legend_entries(const ContourMap& map) {
  using enum LegendEntry::Sample;
  std::vector<LegendEntry> entries;
  for (const ColouredRegion& region : map.regions) {
    entries.push_back({area, region.colour, region.meaning});
  }
  const auto add = [&](bool is_shown, LegendEntry entry) {
    if (is_shown) entries.push_back(std::move(entry));
  };
  add(!map.contours.empty(), {line, line_style(1.3, "#2e6fa8"), map.contour_meaning});
  add(!map.other_contours.empty(), {line, other_contour_style(), map.other_meaning});
  add(!map.boundary.empty(), {line, boundary_style(), map.boundary_meaning});
  add(!map.hatching.empty(), {hatching, "", map.hatching_meaning});
  const bool is_line_alone = !map.inner_boundary.empty() && map.inner_hatching.empty();
  add(is_line_alone, {line, inner_boundary_style(), map.inner_meaning});
  add(!map.inner_hatching.empty(), {dense_hatching, "", map.inner_meaning});
  add(map.mark.has_value(), {point, "", map.mark_meaning});
  return entries;
}

constexpr double sample_width = 0.05;  // shares of the picture's width
constexpr double half_height = 0.013;  // share of its height

std::string sample_commands(const LegendEntry& entry, double right, double middle) {
  using enum LegendEntry::Sample;
  constexpr double slant = 2.0 * half_height * 7.0 / 9.0;
  std::string commands;
  switch (entry.sample) {
    case line:
      return screen_line(right, middle, right + sample_width, middle, entry.style);
    case hatching:
    case dense_hatching: {
      const double spacing = entry.sample == hatching ? 0.0085 : 0.00425;
      for (double place = 0.0; place + slant <= sample_width; place += spacing) {
        commands += screen_line(right + place, middle - half_height, right + place + slant,
                                middle + half_height, hatching_style());
      }
      return commands;
    }
    case point:
      return fmt::format("set label '' at screen {:.4f}, {:.4f} point {}\n",
                         right + 0.5 * sample_width, middle, mark_style());
    case area:
      return fmt::format(
          "set object rectangle from screen {:.4f}, {:.4f} to screen {:.4f}, {:.4f} fillcolor rgb "
          "'{}' fillstyle solid border linecolor rgb '#909090'\n",
          right, middle - half_height, right + sample_width, middle + half_height, entry.style);
  }
  return commands;
}

/// A sample of each kind of line and area with its meaning, side by side below the axis, in two
/// lines if one is too short. gnuplot's own legend has no hatching that looks the same in all
/// formats.
std::string legend(const ContourMap& map, PictureFormat format) {
  constexpr double space = 0.012;
  constexpr double between = 0.05;
  constexpr double widest = 0.88;  // of a line
  const double letter = letter_size(format).width / label_scale / 9.0;
  const std::vector<LegendEntry> entries = legend_entries(map);
  const auto width_of = [&](const LegendEntry& entry) {
    return sample_width + space + letter * static_cast<double>(width_in_columns(entry.meaning));
  };
  std::vector<std::vector<LegendEntry>> lines(1);
  double width = -between;
  for (const LegendEntry& entry : entries) {
    width += width_of(entry) + between;
    if (width > widest && lines.size() == 1) {
      lines.emplace_back();
      width = width_of(entry);
    }
    lines.back().push_back(entry);
  }
  std::string commands = "unset key\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    constexpr double lowest = 0.04;  // shares of the picture's height
    const double middle = lines.size() == 1 ? lowest : 0.054 - 0.036 * static_cast<double>(i);
    double whole = -between;
    for (const LegendEntry& entry : lines[i]) whole += width_of(entry) + between;
    double right = 0.5 * (Paper::left_margin + Paper::right_margin - whole);
    for (const LegendEntry& entry : lines[i]) {
      commands += sample_commands(entry, right, middle);
      commands += fmt::format("set label {} at screen {:.4f}, {:.4f} left\n", quoted(entry.meaning),
                              right + sample_width + space, middle);
      right += width_of(entry) + between;
    }
  }
  return commands;
}

}  // namespace

std::string draw_contour_map(const ContourMap& map, PictureFormat format) {
  const Paper paper(map.x, map.y);
  DrawnContours drawing;
  drawing.commands = terminal(format) + heading(map.title, map.subtitle);
  drawing.commands +=
      fmt::format("set lmargin screen {}\nset rmargin screen {}\nset bmargin screen {}\n",
                  Paper::left_margin, Paper::right_margin, Paper::bottom_margin);
  drawing.commands += axis_commands('x', map.x) + axis_commands('y', map.y) +
                      "set ylabel offset 1,0\n" + legend(map, format);
  add_regions(map, paper, drawing);
  drawing.add(curves_block("hatching", map.hatching, paper), "hatching", hatching_style());
  drawing.add(curves_block("inner_hatching", map.inner_hatching, paper), "inner_hatching",
              hatching_style());
  drawing.add(curves_block("inner_boundary", map.inner_boundary, paper), "inner_boundary",
              inner_boundary_style());
  add_contours(map, paper, format, drawing);
  drawing.add(curves_block("boundary", map.boundary, paper), "boundary", boundary_style());
  if (map.mark) {
    DataBlock block("mark");
    block.row(map.mark->x, map.mark->y);
    drawing.commands += block.text();
    drawing.layers.push_back("$mark using 1:2 with points " + mark_style() + " notitle");
  }
  if (drawing.layers.empty()) drawing.layers.emplace_back("1/0 notitle");  // keeps the axes
  return run_gnuplot(drawing.commands + plot_command(drawing.layers), map.title);
}

}  // namespace gearlash
