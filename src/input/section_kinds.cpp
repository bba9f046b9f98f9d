#include "input/section_kinds.hpp"

#include "base/lists.hpp"
#include "input/section_reader.hpp"

namespace gearlash {

std::vector<std::pair<Drive, std::string_view>> drives_of_kinds(const Drive& drive,
                                                                const std::string& section) {
  std::vector<std::pair<Drive, std::string_view>> drives;
  const Parameter* kind = find_parameter(section + ".kind");
  for (std::size_t i = 0; kind != nullptr && i < kind->choices.size(); ++i) {
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
  std::vector<std::string> kinds;
  for (const auto& of_kind : drives_of_kinds(drive, section)) {
    const bool has_it = any_of(all_parameters_of_drives(), [&](const Parameter& parameter) {
      return has_name(parameter, section + "." + key) && exists(parameter, of_kind.first);
    });
    if (has_it) kinds.push_back("\"" + std::string(of_kind.second) + "\"");
  }
  if (kinds.empty()) return "";
  const Parameter& kind = *find_parameter(section + ".kind");
  Drive copy = drive;
  const std::size_t present = std::get<Choice>(kind.slot(copy)).chosen(copy);
  return "is not a key of [" + section + "] with kind = \"" + std::string(kind.choices[present]) +
         "\", but with " + alternatives(kinds);
}

}  // namespace gearlash
