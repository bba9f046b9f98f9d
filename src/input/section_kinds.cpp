#include "input/section_kinds.hpp"

#include "base/lists.hpp"
#include "input/section_reader.hpp"

namespace gearlash {
namespace {

/// The kinds of a section, in quotes, with which the drive has a parameter of that name.
std::vector<std::string> kinds_with(const std::string& path, const Drive& drive,
                                    const std::string& section) {
  std::vector<std::string> kinds;
  for (const auto& of_kind : drives_of_kinds(drive, section)) {
    const bool has_it = any_of(all_parameters_of_drives(), [&](const Parameter& parameter) {
      return has_name(parameter, path) && exists(parameter, of_kind.first);
    });
    if (has_it) kinds.push_back("\"" + std::string(of_kind.second) + "\"");
  }
  return kinds;
}

}  // namespace

std::vector<std::pair<Drive, std::string_view>> drives_of_kinds(const Drive& drive,
                                                                const std::string& section) {
  std::vector<std::pair<Drive, std::string_view>> drives;
  const Parameter* kind = find_parameter(section + ".kind");
  if (kind == nullptr || !exists(*kind, drive)) return {};
  for (std::size_t i = 0; i < kind->choices.size(); ++i) {
    drives.emplace_back(drive, kind->choices[i]);
    std::get<Choice>(kind->slot(drives.back().first)).choose(drives.back().first, i);
  }
  return drives;
}

bool is_of_every_kind(const Parameter& parameter, const Drive& drive, const std::string& section) {
  return all_of(drives_of_kinds(drive, section),
                [&](const auto& of_kind) { return exists(parameter, of_kind.first); });
}

std::string why_of_other_kind(const Drive& drive, const std::string& section,
                              const std::string& key) {
  const std::string path = section + "." + key;
  const std::vector<std::string> kinds = kinds_with(path, drive, section);
  const Parameter* kind = find_parameter(section + ".kind");
  if (!kinds.empty()) {
    Drive copy = drive;
    const std::size_t present = std::get<Choice>(kind->slot(copy)).chosen(copy);
    return "is not a key of [" + section + "] with kind = \"" +
           std::string(kind->choices[present]) + "\", but with " + alternatives(kinds);
  }
  for (const Section& other : all_sections()) {
    const std::string name(other.name);
    const std::vector<std::string> others = kinds_with(path, drive, name);
    if (!others.empty()) return "must stand beside " + name + ".kind = " + alternatives(others);
  }
  return "";
}

}  // namespace gearlash
