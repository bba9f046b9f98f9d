#include "drive_reply.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "analysis/final_servo.hpp"
#include "gearlash/design.hpp"
#include "gearlash/parameter.hpp"
#include "input/written_texts.hpp"
#include "model/parameters.hpp"
#include "output/drive_text.hpp"

namespace gearlash::web {
namespace {

/// A unit and its size in SI.
struct ShownUnit {
  std::string name;
  double in_si = 1.0;
};

/// The author's unit of the parameter, else that of the drive's angles, else SI.
ShownUnit shown_unit(const Parameter& parameter, const WrittenDrive& written,
                     const std::string& text) {
  const Dimension* dimension = parameter.dimension(written.drive);
  if (dimension == nullptr) return {};
  if (!text.empty()) {
    try {
      const Measured measured = read_quantity(parameter.path, text, *dimension);
      if (!measured.unit.empty()) return {measured.unit, measured.unit_in_si};
    } catch (const InvalidInput&) {  // written in another form: "43:1", a frequency for a period
    }
  }
  if (dimension->unit == "rad") return {written.angle.name, written.angle.radians};
  return {std::string(dimension->unit), 1.0};
}

/// Where a slider runs: the registry's range if it holds the value, else ten times down and up.
Json slider(const Parameter& parameter, double value) {
  const UsualRange& usual = parameter.usual;
  if (parameter.permitted == Permitted::share) {
    return {{"low", 0.0}, {"high", 1.0}, {"logarithmic", false}};
  }
  const bool is_of_form = parameter.permitted == Permitted::of_normal_form && usual.high > 0.0;
  if (is_of_form && value >= usual.low && value <= usual.high) {
    return {{"low", usual.low}, {"high", usual.high}, {"logarithmic", usual.is_logarithmic}};
  }
  constexpr double factor = 10.0;
  if (value > 0.0 && std::isfinite(value)) {
    return {{"low", value / factor}, {"high", value * factor}, {"logarithmic", true}};
  }
  if (value < 0.0 && std::isfinite(value)) {
    return {{"low", 2.0 * value}, {"high", -2.0 * value}, {"logarithmic", false}};
  }
  const double high = usual.high > 0.0 ? usual.high : 1.0;
  return {{"low", 0.0}, {"high", high}, {"logarithmic", false}};
}

const char* name_of(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::number:
      return "number";
    case ParameterKind::choice:
      return "choice";
    case ParameterKind::list:
      return "list";
    case ParameterKind::matrix:
      return "matrix";
    case ParameterKind::file:
      return "file";
  }
  return "";
}

/// All that the page shows of the parameters.
class ParameterList {
 public:
  ParameterList(const DriveText& text, const WrittenDrive& written)
      : written_(written),
        texts_(texts_written_in(text.toml)),
        values_(drive_json(written.drive)),
        defaults_(defaults_taken(written.drive)),
        usual_(usual_parameters(written.drive)) {
    for (const Setting& setting : text.settings) texts_[setting.path] = setting.text;
  }

  Json all() const {
    return json_list(parameters_of(written_.drive),
                     [&](const ParameterInfo& info) { return one(info); });
  }

 private:
  Json one(const ParameterInfo& info) const {
    const std::string path(info.path);
    const Json& value = values_[path];
    Json json = {{"path", path},
                 {"kind", name_of(info.kind)},
                 {"meaning", info.meaning},
                 {"value", value},
                 {"is_default", contains(defaults_, path)},
                 {"is_usual", contains(usual_, path)},
                 {"is_required", info.is_required}};
    if (info.kind == ParameterKind::choice) {
      json["choices"] = json_list(info.choices, [](std::string_view word) { return word; });
    }
    if (info.kind == ParameterKind::number) add_number(value, *find_parameter(path), json);
    return json;
  }

  void add_number(const Json& value, const Parameter& parameter, Json& json) const {
    const auto text = texts_.find(std::string(parameter.path));
    const ShownUnit unit =
        shown_unit(parameter, written_, text == texts_.end() ? std::string() : text->second);
    json["unit"] = unit.name;
    json["unit_in_si"] = unit.in_si;
    json["slider"] = slider(parameter, value.is_number() ? value.get<double>() : 0.0);
  }

  static bool contains(const std::vector<std::string>& list, const std::string& path) {
    return std::find(list.begin(), list.end(), path) != list.end();
  }

  const WrittenDrive& written_;
  std::map<std::string, std::string> texts_;
  Json values_;
  std::vector<std::string> defaults_;
  std::vector<std::string> usual_;
};

/// Sections that the drive could have too.
Json absent_sections(const Drive& drive) {
  Json json = Json::array();
  for (const Section& section : all_sections()) {
    if (section.add == nullptr || section.is_present(drive)) continue;
    json.push_back({{"name", section.name}, {"contents", section.contents}});
  }
  return json;
}

}  // namespace

DriveText drive_text_of(const Json& json) {
  DriveText text{.toml = json.at("toml"), .name = json.value("name", "drive.toml"), .settings = {}};
  for (const Json& setting : json.value("settings", Json::array())) {
    text.settings.push_back({.path = setting.at(0), .text = setting.at(1)});
  }
  return text;
}

WrittenDrive parse(const DriveText& text, const std::string& folder) {
  return parse_drive(text.toml, text.name, folder, text.settings);
}

Json drive_reply(const DriveText& text, const WrittenDrive& written) {
  return {{"parameters", ParameterList(text, written).all()},
          {"absent", absent_sections(written.drive)},
          {"is_normal_form", written.drive.servo.has_value()},
          {"has_closed_form", closed_form_drive(written.drive).has_value()}};
}

Json file_reply(const WrittenDrive& written) {
  return {{"toml", to_toml(TolerancedDrive{written.drive, written.tolerances})}};
}

}  // namespace gearlash::web
