#include "verb.hpp"

#include <algorithm>
#include <cstdio>
#include <new>
#include <string_view>
#include <system_error>

#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "gearlash/units.hpp"

namespace gearlash::cli {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-_./=,:+@%").find(c) != std::string_view::npos;
}

std::string shell_quoted(const std::string& argument) {
  if (!argument.empty() && all_of(argument, is_plain)) return argument;
  // Control characters are escaped by shown(): the command stays on its line, in a CSV file too.
  std::string quoted = "'";
  for (const char c : argument.empty() ? argument : shown(argument, std::string_view::npos)) {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

/// "200 MB", in bytes.
double read_memory(const std::string& text) {
  constexpr double least = 100e6;
  const std::optional<double> bytes = bytes_of(text);
  if (!bytes || !(*bytes >= least)) {
    refuse("--memory-limit", text, "must be a size of at least 100 MB: \"200 MB\", \"1 GiB\"");
  }
  return *bytes;
}

}  // namespace

std::string help_footer(const std::string& examples) {
  return "Exit status:\n"
         "  0  done, whether the drive hunts or not\n"
         "  1  undecided, or stopped by a limit; the results so far are printed\n"
         "  2  bad input; standard error has one line per fault\n"
         "  3  the machine failed: output, memory, threads or gnuplot; an answer that exists is "
         "still printed\n"
         "  130, 143  ended by Ctrl-C or SIGTERM\n\n"
         "Examples:\n" +
         examples.substr(0, examples.find_last_not_of('\n') + 1);
}

std::string typed_command(const std::vector<std::string>& words) {
  std::string command = "gearlash";
  for (const std::string& word : words) command += " " + shell_quoted(word);
  return command;
}

void add_format_option(const Command& command, std::string& format) {
  command.add_option("--format FORMAT", format, "Choose the format: text (default) or json");
}

void add_limit_options(const Command& command, LimitOptions& options) {
  command.add_option("--time-limit TIME", options.time,
                     "Stop the work after this time and print what is known by then, with exit "
                     "status 1: \"30 s\"");
  command.add_option("--memory-limit SIZE", options.memory,
                     "Stop the work likewise once the tool has taken this much memory, 100 MB or "
                     "more: \"200 MB\"");
}

Limits read_limits(const LimitOptions& options, Faults& faults) {
  Limits limits;
  if (!options.time.empty()) limits.seconds = read_time("--time-limit", options.time, faults);
  if (!options.memory.empty()) {
    limits.bytes = faults.collect([&] { return read_memory(options.memory); }, no_limit);
  }
  return limits;
}

ExitStatus end_work(LimitedWork& work, ExitStatus status, const std::string& unknown) {
  if (work.is_stopped()) report_lines("stopped by " + work.why() + ": " + unknown);
  work.end();
  return work.is_stopped() ? ExitStatus::undecided : status;
}

Option add_plot_option(const Command& command, std::vector<std::string>& typed,
                       const std::string& kinds) {
  return command.add_option("--plot KIND=FILE", typed,
                            kinds + " FILE ends in .svg, .png or .pdf; repeatable",
                            {.takes_one_word = true});
}

std::vector<PlotFile> read_plots(const std::vector<std::string>& typed,
                                 const std::vector<std::string>& kinds, Faults& faults) {
  const auto forms = of_each(kinds, [](const std::string& kind) { return kind + "=FILE"; });
  std::vector<PlotFile> plots;
  for (const std::string& text : typed) {
    const std::size_t sign = text.find('=');
    const std::string kind = text.substr(0, sign);
    if (sign == std::string::npos || !contains(kinds, kind)) {
      faults.add({"--plot", shown(text), "must be " + alternatives(forms) + guess_of(kinds, kind)});
      continue;
    }
    plots.push_back(read_picture("--plot", text.substr(sign + 1), faults));
    plots.back().kind = kind;
  }
  return plots;
}

PlotFile read_picture(const char* field, const std::string& file, Faults& faults) {
  return {
      .file = file,
      .format = faults.collect([&] { return picture_format(field, file); }, PictureFormat::svg)};
}

std::vector<FileUse> files_of(const std::vector<PlotFile>& plots) {
  return of_each(plots, [](const PlotFile& plot) { return FileUse{"--plot", plot.file}; });
}

bool has_kind(const std::vector<PlotFile>& plots, const std::string& kind) {
  return any_of(plots, [&](const PlotFile& plot) { return plot.kind == kind; });
}

void write_plot(const PlotFile& file, const Plot& plot) {
  write_file(file.file, draw(plot, file.format));
}

void refuse_to_draw(const PlotFile& file) {
  throw OutputError(file.file + ": not drawn: the work was stopped before");
}

void report_lines(const std::string& lines) {
  std::size_t start = 0;
  while (start < lines.size()) {
    const std::size_t end = std::min(lines.find('\n', start), lines.size());
    std::fputs(("gearlash: " + lines.substr(start, end - start) + "\n").c_str(), stderr);
    start = end + 1;
  }
}

bool is_within_means(const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const OutputError& error) {
    report_lines(error.what());
  } catch (const std::bad_alloc&) {
    report_lines("not enough memory");
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) throw;
    report_lines("no thread could be started: " + error.code().message());
  }
  return false;
}

void Extras::print(const std::string& answer) {
  make([&] { write_file("-", answer); });
}

void Extras::make(const std::function<void()>& work) {
  try {
    if (!is_within_means(work)) failure_ = ExitStatus::beyond_means;
  } catch (const InvalidInput& error) {  // what the answer shows to be impossible
    report_lines(error.what());
    if (!failure_) failure_ = ExitStatus::bad_input;
  } catch (const ReaderGone&) {  // of a pipe that a picture went into
  }
}

ExitStatus give(const Answered& answered, LimitedWork& work,
                const std::function<void(Extras& extras)>& make_others) {
  Extras extras;
  extras.print(answered.text);
  report_lines(answered.remark);
  const ExitStatus status = end_work(
      work, answered.is_decided ? ExitStatus::done : ExitStatus::undecided, answered.unknown);
  make_others(extras);
  return extras.status(status);
}

ExitStatus give(const Answered& answered, LimitedWork& work, const std::vector<PlotFile>& plots,
                const std::function<Plot(const PlotFile& file)>& plot_of) {
  return give(answered, work, [&](Extras& extras) {
    for (const PlotFile& file : plots) {
      extras.make([&] { write_plot(file, plot_of(file)); });
    }
  });
}

}  // namespace gearlash::cli
