#include <limits>
#include <utility>

#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "input/drive_reader.hpp"
#include "input/foreign_words.hpp"
#include "input/parameter_text.hpp"
#include "input/toml_document.hpp"
#include "input/utf8.hpp"
#include "model/parameter_values.hpp"
#include "model/parameters.hpp"

namespace gearlash {
namespace {

constexpr std::string_view nothing = "none";

/// Whether a file of any form has a section of this name: "sampling", "actuator".
bool is_section(std::string_view name) {
  const auto is_in_it = [&](std::string_view path) { return section_of(path) == name; };
  return any_of(all_parameters_of_drives(),
                [&](const Parameter& parameter) { return any_of(paths_of(parameter), is_in_it); });
}

/// Removes a key under any of its names.
void take_out(TomlDocument& document, const Parameter& parameter) {
  for (const std::string_view path : paths_of(parameter)) document.remove(path);
}

/// Of every kind of drive.
std::vector<const Parameter*> parameters_named(std::string_view path) {
  std::vector<const Parameter*> named;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (has_name(parameter, path)) named.push_back(&parameter);
  }
  return named;
}

/// Removes a section with its keys under any of their names ("actuator.timestep" is of [sampling]),
/// or a key.
void take_out(TomlDocument& document, const std::string& path) {
  for (const Parameter* parameter : parameters_named(path)) take_out(document, *parameter);
  if (!is_section(path)) return;
  document.remove_section(path);
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (parameter.section() == path) take_out(document, parameter);
  }
}

/// Names of files are bytes of any kind.
bool is_name_of_file(std::string_view path) {
  const Parameter* parameter = find_parameter(path);
  return parameter != nullptr && parameter->key() == "file";
}

/// Why no drive has the path of a setting, with the nearest known one; empty if one has.
std::string why_unknown(const Setting& setting) {
  const bool is_without = setting.text == nothing && is_section(setting.path);
  if (is_without || find_parameter(setting.path) != nullptr) return {};
  std::vector<std::string> paths;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    for (const std::string_view path : paths_of(parameter)) paths.emplace_back(path);
  }
  return "must be a parameter of a drive" + guess_of_path(setting.path, paths);
}

/// Removes the parameters of that name from the document, under whatever names it gives them.
/// Returns where a value with the meaning of `path` may then stand.
std::string cleared_place(TomlDocument& document, const std::string& path) {
  std::string place = path;
  // [loop] is a controller with keys of its own.
  const bool has_loop = document.root().contains("loop") && !document.root().contains("controller");
  for (const Parameter* parameter : parameters_named(path)) {
    const OtherForm* named = form_named(*parameter, path);
    const bool is_direct = named == nullptr || named->relation == Relation::same;
    const bool is_of_other_section = parameter->section() != section_of(path);
    if (document.remove(parameter->path) && is_direct && is_of_other_section) {
      place = parameter->path;
    }
    for (const OtherForm& form : parameter->other_forms) {
      const bool has_same_meaning = form.relation == Relation::same && is_direct;
      const bool is_of_loop = has_loop && section_of(form.path) == "loop";
      if ((document.remove(form.path) || is_of_loop) && has_same_meaning) place = form.path;
    }
  }
  return place;
}

/// Replaces the parameter's value, under whatever name the document gives it.
void apply(TomlDocument& document, const Setting& setting) {
  if (const std::string why = why_unknown(setting); !why.empty()) {
    refuse(setting.path, setting.text, why);
  }
  if (setting.text == nothing) return take_out(document, setting.path);
  const std::string place = cleared_place(document, setting.path);
  // Everything but a list or a table becomes text, which the key's reader parses: "30 arcmin",
  // "1/4".
  if (const std::optional<toml::array> list = list_in(setting.text)) {
    document.set(place, *list, setting.text);
  } else if (const std::optional<toml::table> table = table_in(setting.text)) {
    document.set(place, *table, setting.text);
  } else {
    document.set(place, toml::value<std::string>(setting.text), setting.text);
  }
}

std::map<std::string, std::string> texts_of(const TomlDocument& document) {
  std::map<std::string, std::string> texts;
  for (const auto& [section, node] : document.root()) {
    const toml::table* table = node.as_table();
    if (table == nullptr) continue;
    for (const auto& [key, value] : *table) {
      const auto* written = value.as_string();
      if (written == nullptr) continue;
      texts[std::string(section.str()) + "." + std::string(key.str())] = written->get();
    }
  }
  return texts;
}

/// The contents of a document with settings.
WrittenDrive contents_of(TomlDocument& document, const std::vector<Setting>& settings,
                         const std::filesystem::path& folder, BareNumbers bare_numbers) {
  std::map<std::string, std::string> texts = texts_of(document);
  for (const Setting& setting : settings) apply(document, setting);
  Findings findings(document);
  WrittenDrive written = read_drive(document, findings, folder, {}, bare_numbers);
  findings.require_none();
  written.texts = std::move(texts);
  return written;
}

}  // namespace

WrittenDrive parse_drive(std::string_view toml, std::string_view source_name,
                         const std::filesystem::path& folder, const std::vector<Setting>& settings,
                         BareNumbers bare_numbers) {
  // What a program has in memory may be longer than a file: the points of its tables.
  const std::size_t most_bytes = bare_numbers == BareNumbers::in_si
                                     ? std::numeric_limits<std::size_t>::max()
                                     : largest_drive_file;
  TomlDocument document(toml, source_name, most_bytes);
  return contents_of(document, settings, folder, bare_numbers);
}

WrittenDrive parse_drive_by_form(std::string_view toml, std::string_view source_name,
                                 const std::filesystem::path& folder,
                                 const SettingsOfForm& settings) {
  TomlDocument document(toml, source_name, largest_drive_file);
  const bool is_normal_form = document.root().contains("servo");
  WrittenDrive written =
      contents_of(document, settings(is_normal_form), folder, BareNumbers::refused);
  written.text = toml;
  return written;
}

std::vector<NamedTable> named_tables(Drive& drive) {
  std::vector<NamedTable> tables;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const Slot slot = parameter.slot(drive);
    if (auto* const* name = std::get_if<std::string*>(&slot);
        name != nullptr && !(*name)->empty()) {
      tables.push_back({parameter.path, *name});
    }
  }
  return tables;
}

Setting read_setting(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || sign == 0) {
    refuse("--set", text, "must be PATH=VALUE, such as gearbox.ratio=50");
  }
  Setting setting{text.substr(0, sign), text.substr(sign + 1)};
  if (const std::string why = why_unknown(setting); !why.empty()) {
    refuse("--set", setting.path, why);
  }
  if (as_utf8(text) != text && !is_name_of_file(setting.path)) {
    refuse("--set", text, "must be UTF-8, as the text of a file is");
  }
  return setting;
}

const char* name_of(SensorPlace place) {
  constexpr const char* names[] = {"load", "motor", "both"};
  return names[static_cast<std::size_t>(place)];
}

Drive read_drive(const std::filesystem::path& toml) { return read_toleranced_drive(toml).nominal; }

TolerancedDrive read_toleranced_drive(const std::filesystem::path& toml) {
  WrittenDrive written =
      parse_drive(read_text_file(toml, largest_drive_file), toml.string(), toml.parent_path(), {});
  return {std::move(written.drive), std::move(written.tolerances)};
}

Drive parse_drive(std::string_view toml, const std::filesystem::path& folder) {
  return parse_drive(toml, "drive", folder, {}).drive;
}

}  // namespace gearlash
