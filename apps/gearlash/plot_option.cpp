#include "plot_option.hpp"

#include <algorithm>

#include "input/section_reader.hpp"
#include "output/output_file.hpp"
#include "picture/gnuplot_renderer.hpp"

namespace gearlash::cli {
std::vector<PlotFile> read_plots(const std::vector<std::string>& typed,
                                 const std::vector<std::string>& kinds, Faults& faults) {
  std::vector<std::string> forms;
  for (const std::string& kind : kinds) forms.push_back(kind + "=FILE");
  std::vector<PlotFile> plots;
  for (const std::string& text : typed) {
    const std::size_t sign = text.find('=');
    const std::string kind = text.substr(0, sign);
    if (sign == std::string::npos || std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
      faults.add(
          {"--plot", shown(text), "must be " + alternatives(forms) + guess_of(kinds, kind), ""});
      continue;
    }
    const std::string file = text.substr(sign + 1);
    plots.push_back(
        {kind, file,
         faults.collect([&] { return picture_format("--plot", file); }, PictureFormat::svg)});
  }
  return plots;
}

std::vector<FileUse> files_of(const std::vector<PlotFile>& plots) {
  std::vector<FileUse> files;
  for (const PlotFile& plot : plots) files.push_back({"--plot", plot.file});
  return files;
}

bool has_kind(const std::vector<PlotFile>& plots, const std::string& kind) {
  return std::any_of(plots.begin(), plots.end(),
                     [&](const PlotFile& plot) { return plot.kind == kind; });
}

void write_plot(const PlotFile& file, const Plot& plot) {
  write_file(file.file, draw(plot, file.format));
}

Option* add_plot_option(Command& command, std::vector<std::string>& typed,
                        const std::string& kinds) {
  return command
      .add_option("--plot KIND=FILE", typed, kinds + " FILE ends in .svg, .png or .pdf; repeatable")
      ->allow_extra_args(false);
}

}  // namespace gearlash::cli
