#include "drive_reply.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "gearlash/design.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"
#include "output/drive_text.hpp"
#include "question/family/family.hpp"

namespace gearlash::web {
namespace {

/// Where a slider runs: the registry's range of a normal form that is in it, a share's, else that
/// of the axis searched if nothing else is known, from 0 or on both sides of it where the value
/// needs it.
Json slider(const Drive& drive, const Parameter& parameter, double value) {
  const UsualRange& usual = parameter.usual;
  const bool is_of_form = parameter.permitted == Permitted::of_normal_form && usual.high > 0.0;
  if (is_of_form && value >= usual.low && value <= usual.high) {
    return {{"low", usual.low}, {"high", usual.high}, {"logarithmic", usual.is_logarithmic}};
  }
  if (value < 0.0) return {{"low", 2.0 * value}, {"high", -2.0 * value}, {"logarithmic", false}};
  Axis axis{.values = {0.0, 1.0}};
  try {
    axis = usual_axis(drive, parameter.path);
  } catch (const InvalidInput&) {  // it has no usual range, and no value to take one from
  }
  const bool is_by_ratio = axis.logarithmic && value > 0.0;
  const double first = axis.values.front();
  const double low = !is_by_ratio ? 0.0 : first > 0.0 ? first : axis.values.at(1);
  return {{"low", low}, {"high", axis.values.back()}, {"logarithmic", is_by_ratio}};
}

/// The names of ParameterKind, in its order.
constexpr std::array kinds = {"number", "choice", "list", "matrix", "file"};
static_assert(kinds.size() == static_cast<std::size_t>(ParameterKind::file) + 1);

/// All that the page shows of the parameters.
class ParameterList {
 public:
  ParameterList(const DriveText& text, const WrittenDrive& written)
      : written_(written),
        units_(text, written),
        values_(drive_json(written.drive)),
        defaults_(defaults_taken(written.drive)),
        usual_(usual_parameters(written.drive)) {}

  Json all() const {
    return json_list(parameters_of(written_.drive),
                     [&](const ParameterInfo& info) { return one(info); });
  }

 private:
  Json one(const ParameterInfo& info) const {
    const std::string path(info.path);
    const Json& value = values_[path];
    Json json = {{"path", path},
                 {"kind", kinds.at(static_cast<std::size_t>(info.kind))},
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
    const ShownUnit unit = units_.of(parameter);
    json["unit"] = unit.name;
    json["unit_in_si"] = unit.in_si;
    json["slider"] =
        slider(written_.drive, parameter, value.is_number() ? value.get<double>() : 0.0);
  }

  static bool contains(const std::vector<std::string>& list, const std::string& path) {
    return std::find(list.begin(), list.end(), path) != list.end();
  }

  const WrittenDrive& written_;
  ShownUnits units_;
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

ShownUnits::ShownUnits(const DriveText& text, const WrittenDrive& written)
    : written_(written), texts_(written.texts) {
  for (const Setting& setting : text.settings) texts_[setting.path] = setting.text;
}

ShownUnit ShownUnits::of(const Parameter& parameter) const {
  const Dimension* dimension = parameter.dimension(written_.drive);
  if (dimension == nullptr) return {};
  if (const auto text = texts_.find(std::string(parameter.path)); text != texts_.end()) {
    try {
      const Measured measured = read_quantity(parameter.path, text->second, *dimension);
      if (!measured.unit.empty()) return {measured.unit, measured.unit_in_si};
    } catch (const InvalidInput&) {  // written in another form: "43:1", a frequency for a period
    }
  }
  if (dimension->unit == "rad") return {written_.angle.name, written_.angle.radians};
  return {std::string(dimension->unit), 1.0};
}

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
          {"is_searched", engines_of(written.drive).search}};
}

Json file_reply(const WrittenDrive& written) {
  return {{"toml", to_toml(TolerancedDrive{written.drive, written.tolerances})}};
}

}  // namespace gearlash::web
