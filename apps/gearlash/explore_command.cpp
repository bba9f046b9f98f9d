// gearlash explore: the drive in a page of its own, which any browser opens without a network.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "input/utf8.hpp"
#include "output/drive_text.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char explore_examples[] =
    "  gearlash explore examples/robot-joint.toml --output joint.html\n"
    "  gearlash explore examples/elinco-fd162.toml --backlash \"12 arcmin\" --output servo.html\n"
    "  gearlash explore --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1 --backlash 0.3 \\\n"
    "      --output hunting.html\n";

namespace fs = std::filesystem;

struct ExploreOptions {
  ServoOptions servo;
  std::string output;
};

/// The page without a drive, as `make web` makes it: installed beside the tool, or in the build.
fs::path page_without_drive() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path places[] = {folder.parent_path() / "share/gearlash/explorer.html",
                             folder.parent_path() / "web/site/explorer.html"};
  for (const fs::path& place : places) {
    if (fs::is_regular_file(place, error)) return place;
  }
  throw OutputError("the page is not installed: " + places[0].string() +
                    " is missing; in the sources, `make web` makes it");
}

/// For a script element, which "</" would end.
std::string escaped(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

/// The tables that a drive names: contents by name, and settings by which the page finds those that
/// stand in other folders, or whose names are not UTF-8.
struct Tables {
  nlohmann::ordered_json files = nlohmann::ordered_json::object();
  nlohmann::ordered_json settings = nlohmann::ordered_json::array();
};

/// Names them as the page does. A drive from standard input names them relative to the working
/// folder.
Tables take_tables(Drive& drive, const std::string& file) {
  constexpr std::size_t largest_table = 64U * 1024U * 1024U;
  const fs::path folder = file == "-" ? fs::path() : fs::path(file).parent_path();
  Tables tables;
  for (const NamedTable& table : named_tables(drive)) {
    const fs::path written = *table.file;
    const std::string base = as_utf8(written.filename().string());
    tables.files[base] = as_utf8(read_text_file(folder / written, largest_table));
    if (*table.file != base) {
      tables.settings.push_back(nlohmann::ordered_json::array({table.path, base}));
    }
    *table.file = base;
  }
  return tables;
}

/// Whether options other than --set change what the file has.
bool has_number_options(const ServoOptions& options) {
  const auto is_typed = [](const auto& number) { return number.has_value(); };
  return options.sensor || any_of(options.numbers, is_typed);
}

/// The author's own text with the settings, so that the page shows both.
nlohmann::ordered_json drive_of_page(const ServoOptions& options, WrittenDrive written) {
  Tables tables = take_tables(written.drive, options.file);
  if (options.file.empty() || options.file == "-" || has_number_options(options)) {
    return {{"toml", to_toml(TolerancedDrive{written.drive, written.tolerances})},
            {"name", "drive.toml"},
            {"settings", std::move(tables.settings)},
            {"files", std::move(tables.files)}};
  }
  nlohmann::ordered_json settings = nlohmann::ordered_json::array();
  for (const std::string& text : options.settings) {
    const Setting setting = read_setting(text);
    settings.push_back(nlohmann::ordered_json::array({setting.path, as_utf8(setting.text)}));
  }
  for (nlohmann::ordered_json& table : tables.settings) settings.push_back(std::move(table));
  return {{"toml", std::move(written.text)},
          {"name", as_utf8(fs::path(options.file).filename().string())},
          {"settings", std::move(settings)},
          {"files", std::move(tables.files)}};
}

ExitStatus run(const ExploreOptions& options, const Provenance&) {
  Faults faults;
  if (fs::path(options.output).extension() != ".html" && options.output != "-") {
    faults.add("--output", shown(options.output), "must end in .html");
  }
  const std::optional<WrittenDrive> written =
      resolve_drive(options.servo, {{"--output", options.output}}, faults);
  faults.require_none();
  const fs::path without_drive = page_without_drive();
  faults.require_distinct({{"the page without a drive", without_drive.string()}},
                          {{"--output", options.output}});
  faults.require_none();
  constexpr std::size_t largest_page = 16U * 1024U * 1024U;
  std::string page = read_text_file(without_drive, largest_page);
  const std::string place = "id=\"user-drive\">";
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw OutputError("the page has no place for a drive");
  page.insert(at + place.size(), escaped(drive_of_page(options.servo, *written).dump()));
  write_file(options.output, page);
  if (options.output != "-") write_file("-", options.output + ": open it in a browser\n");
  return ExitStatus::done;
}

}  // namespace

void add_explore_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<ExploreOptions>(
      app, action, "explore",
      "Write the drive as a page for the browser, with sliders and pictures",
      help_footer(explore_examples), run);
  add_servo_or_drive_options(command, options.servo);
  command.add_option("--output FILE", options.output,
                     "Write this page, .html: one file, which works offline and in a mail",
                     {.is_required = true});
}

}  // namespace gearlash::cli
