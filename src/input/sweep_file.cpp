#include <set>

#include "gearlash/input.hpp"
#include "input/drive_reader.hpp"
#include "input/section_reader.hpp"
#include "input/toml_document.hpp"
#include "question/family/evaluation.hpp"

namespace gearlash {
namespace {

constexpr char section_name[] = "sweep";

std::string numbered(const char* key, std::size_t number) {
  return std::string(section_name) + "." + key + "[" + std::to_string(number) + "]";
}

/// Adds the axis's parameter under each path that a file may use for it.
void add_paths(const AxisText& axis, std::set<std::string>& paths) {
  for (const Drive& drive : {Drive{}, normal_form(0.5, 1.0, 0.5)}) {
    const std::string path = path_named(axis.name, drive);
    const Parameter* parameter = find_parameter(path);
    paths.insert(parameter == nullptr ? path : std::string(parameter->path));
  }
}

class SweepReader {
 public:
  SweepReader(std::string_view text, std::string_view source_name,
              const std::filesystem::path& folder)
      : document_(text, source_name, largest_sweep_file), findings_(document_), folder_(folder) {}

  SweepFile read() {
    SectionReader section(document_, findings_, section_name, true, "with axes");
    const std::vector<AxisText> axes = read_axes(section);
    Variation variation{.section = section_name};
    for (const AxisText& axis : axes) add_paths(axis, variation.paths);
    SweepFile file;
    const Drive likely = likely_drive(variation);
    for (const AxisText& axis : axes) {
      std::string left_out;
      note(section, [&] {
        file.grid.axes.push_back(read_axis(axis, drive_of_axes(likely, axes), &left_out));
      });
      if (!left_out.empty()) file.left_out.push_back(std::move(left_out));
    }
    file.quantities = read_quantities(section);
    file.grid.proved = section.choice("verdicts", {"computed", "proved"}, false) == "proved";
    section.refuse_other_keys();
    findings_.require_none();  // the drive's required keys depend on the axes
    file.grid.drive =
        drive_of_axes(read_drive(document_, findings_, folder_, variation).drive, axes);
    findings_.take(faults(file.grid, of_each(axes, &AxisText::field)), section.place());
    findings_.require_none();
    if (file.quantities.empty()) {
      const auto known = quantities_known(Family(file.grid).engines());
      file.quantities.assign(known.begin(), known.end());
    }
    return file;
  }

 private:
  /// Runs `work` and records the faults that it throws.
  template <class Work>
  void note(const SectionReader& section, const Work& work) {
    try {
      work();
    } catch (const InvalidInput& fault) {
      findings_.take(fault.faults(), section.place());
    }
  }

  /// The file's drive with all its faults ignored. Axes need it for their units, and their faults
  /// are reported first.
  Drive likely_drive(const Variation& variation) const {
    Findings ignored(document_);
    const Drive drive = read_drive(document_, ignored, folder_, variation).drive;
    const bool is_none = !drive.servo && !document_.root().contains("motor");
    return is_none ? normal_form(0.5, 1.0, 0.5) : drive;
  }

  std::vector<AxisText> read_axes(SectionReader& section) {
    const std::vector<std::string> texts =
        section.texts("axes", "a list of axes, such as [\"damping=0.1:0.6:6\"]");
    std::vector<AxisText> axes;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const std::string field = numbered("axes", i);
      if (i >= most_axes_of_a_sweep) {
        findings_.take(
            {{field, "", "must be at most " + std::to_string(most_axes_of_a_sweep) + " axes"}},
            section.place());
        break;
      }
      note(section, [&] { axes.push_back(split_axis(field, texts[i])); });
    }
    return axes;
  }

  std::vector<Quantity> read_quantities(SectionReader& section) {
    const std::vector<std::string> texts = section.texts("quantities");
    const std::vector<std::string> names = names_of_quantities(QuantityKind::number);
    std::set<Quantity> asked;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const std::optional<Quantity> quantity = find_quantity(texts[i]);
      if (quantity && quantity != Quantity::verdict) {
        asked.insert(*quantity);
      } else {
        findings_.take({{numbered("quantities", i), "", one_of(names, texts[i])}}, section.place());
      }
    }
    return {asked.begin(), asked.end()};
  }

  TomlDocument document_;
  Findings findings_;
  std::filesystem::path folder_;
};

}  // namespace

SweepFile parse_sweep(std::string_view toml, std::string_view source_name,
                      const std::filesystem::path& folder) {
  SweepFile file = SweepReader(toml, source_name, folder).read();
  file.text = toml;
  return file;
}

SweepFile read_sweep_file(const std::filesystem::path& path) {
  return parse_sweep(read_text_file(path, largest_sweep_file), path.string(), path.parent_path());
}

}  // namespace gearlash
