#include "drive_reply.hpp"

#include <cmath>

#include "base/lists.hpp"
#include "gearlash/design.hpp"
#include "question/family/family.hpp"

namespace gearlash::web {
namespace {

/// Where a slider runs: the registry's range of a normal form that is in it, a share's, else that
/// of the axis searched if nothing else is known, from 0 or on both sides of it where the value
/// needs it.
Slider slider(const Drive& drive, const Parameter& parameter, double value) {
  const UsualRange& usual = parameter.usual;
  const bool is_of_form = parameter.permitted == Permitted::of_normal_form && usual.high > 0.0;
  if (is_of_form && value >= usual.low && value <= usual.high) {
    return {usual.low, usual.high, usual.is_logarithmic};
  }
  if (value < 0.0) return {2.0 * value, -2.0 * value, false};
  Axis axis{.values = {0.0, 1.0}};
  try {
    axis = usual_axis(drive, parameter.path);
  } catch (const InvalidInput&) {  // it has no usual range, and no value to take one from
  }
  const bool is_by_ratio = axis.logarithmic && value > 0.0;
  const double first = axis.values.front();
  const double low = !is_by_ratio ? 0.0 : first > 0.0 ? first : axis.values.at(1);
  return {low, axis.values.back(), is_by_ratio};
}

void show_number(ParameterReply& reply, const WrittenDrive& written, const ShownUnits& units) {
  const Parameter& parameter = *find_parameter(reply.path);
  const ShownUnit unit = units.of(parameter);
  const auto* value = std::get_if<double>(&reply.value);
  reply.unit = unit.name;
  reply.unit_in_si = unit.in_si;
  const bool is_finite = value != nullptr && std::isfinite(*value);
  reply.slider = slider(written.drive, parameter, is_finite ? *value : 0.0);
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
  if (dimension->unit == "rad")
    return {written_.drive.angle_unit.name, written_.drive.angle_unit.radians};
  return {std::string(dimension->unit), 1.0};
}

DriveText drive_text_of(const Json& json) {
  return {.toml = json.at("toml"),
          .name = json.value("name", "drive.toml"),
          .settings = of_each(json.value("settings", Json::array()), [](const Json& setting) {
            return Setting{.path = setting.at(0), .text = setting.at(1)};
          })};
}

WrittenDrive parse(const DriveText& text, const std::string& folder) {
  return parse_drive(text.toml, text.name, folder, text.settings);
}

DriveReply drive_reply(const DriveText& text, const WrittenDrive& written) {
  const Drive& drive = written.drive;
  DriveReply reply{.is_normal_form = drive.servo.has_value(),
                   .is_searched = engines_of(drive).search};
  const ShownUnits units(text, written);
  const ByName<ParameterValue> values = parameter_values(drive);
  const std::vector<std::string> defaults = defaults_taken(drive);
  const std::vector<std::string> usual = usual_parameters(drive);
  for (const ParameterInfo& info : parameters_of(drive)) {
    ParameterReply one{.path = info.path,
                       .kind = info.kind,
                       .meaning = info.meaning,
                       .value = values[reply.parameters.size()].second,
                       .is_default = contains(defaults, info.path),
                       .is_usual = contains(usual, info.path),
                       .is_required = info.is_required,
                       .choices = info.choices};
    if (info.kind == ParameterKind::number) show_number(one, written, units);
    reply.parameters.push_back(std::move(one));
  }
  for (const Section& section : all_sections()) {
    if (section.add == nullptr || section.is_present(drive)) continue;
    reply.absent.push_back({section.name, section.contents});
  }
  return reply;
}

}  // namespace gearlash::web
