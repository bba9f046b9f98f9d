#include "input/sweep_file.hpp"

#include <set>

#include "input/axis_text.hpp"
#include "input/drive_reader.hpp"
#include "input/section_reader.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"

namespace gearlash {
namespace {

constexpr char section_name[] = "sweep";

std::string numbered(const char* key, std::size_t number) {
  return std::string(section_name) + "." + key + "[" + std::to_string(number) + "]";
}

std::string path_of(Input input) {
  return input == Input::restitution ? "contact.restitution"
                                     : std::string("servo.") + name_of(input);
}

std::string same_field(const std::string& field) { return field; }

class SweepReader {
 public:
  SweepReader(std::string_view text, std::string_view source_name)
      : document_(text, source_name, largest_sweep_file), findings_(document_) {}

  SweepFile read() {
    SectionReader section(document_, findings_, section_name, true, "with axes");
    SweepFile file;
    file.grid.axes = read_axes(section);
    file.quantities = read_quantities(section);
    file.grid.proved = section.choice("verdicts", {"computed", "proved"}, false) == "proved";
    section.refuse_other_keys();
    findings_.require_none();  // else it is not known what the servo has to give
    Variation variation{.section = section_name};
    for (const Axis& axis : file.grid.axes) variation.paths.insert(path_of(axis.input));
    const WrittenDrive written = read_drive(document_, findings_, {}, variation);
    if (findings_.none()) {
      if (const auto servo = servo_file_of(written)) file.grid.servo = servo->servo;
    }
    findings_.take(validate(file.grid, axis_fields_), &same_field, section.place());
    findings_.require_none();
    return file;
  }

 private:
  std::vector<Axis> read_axes(SectionReader& section) {
    const std::vector<std::string> texts =
        section.texts("axes", "a list of axes, such as [\"damping=0.1:0.6:6\"]");
    std::vector<Axis> axes;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const std::string field = numbered("axes", i);
      if (i >= most_axes_of_a_sweep) {
        findings_.take(
            {{field, "", "must be at most " + std::to_string(most_axes_of_a_sweep) + " axes", ""}},
            &same_field, section.place());
        break;
      }
      try {
        axes.push_back(read_axis(field, texts[i]));
        axis_fields_.push_back(field);
      } catch (const InvalidInput& fault) {
        findings_.take(fault.faults(), &same_field, section.place());
      }
    }
    return axes;
  }

  std::vector<CycleQuantity> read_quantities(SectionReader& section) {
    const std::vector<std::string> texts = section.texts("quantities");
    if (texts.empty()) return {all_quantities.begin(), all_quantities.end()};
    std::vector<std::string> names;
    for (const CycleQuantity quantity : all_quantities) names.emplace_back(name_of(quantity));
    std::set<CycleQuantity> asked;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (const auto quantity = quantity_named(texts[i])) {
        asked.insert(*quantity);
      } else {
        findings_.take({{numbered("quantities", i), "", one_of(names, texts[i]), ""}}, &same_field,
                       section.place());
      }
    }
    return {asked.begin(), asked.end()};
  }

  TomlDocument document_;
  Findings findings_;
  std::vector<std::string> axis_fields_;
};

}  // namespace

SweepFile parse_sweep(std::string_view toml, std::string_view source_name) {
  SweepFile file = SweepReader(toml, source_name).read();
  file.text = toml;
  return file;
}

SweepFile read_sweep_file(const std::filesystem::path& path) {
  return parse_sweep(read_text_file(path, largest_sweep_file), path.string());
}

}  // namespace gearlash
