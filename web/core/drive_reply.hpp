// A drive with its parameters, as the page's inputs need it.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"
#include "replies.hpp"

namespace gearlash::web {

/// Of requests.
using Json = nlohmann::json;

/// A drive as the page holds it: the text of a file, and what was changed since.
struct DriveText {
  std::string toml;
  std::string name;  ///< of the file, for the places of faults
  std::vector<Setting> settings;
};

/// From {"toml": …, "name": …, "settings": [[path, text], …]}.
DriveText drive_text_of(const Json& json);

/// Tables of signals are in `folder`. Throws InvalidInput with every fault.
WrittenDrive parse(const DriveText& text, const std::string& folder);

/// A unit and its size in SI.
struct ShownUnit {
  std::string name;
  double in_si = 1.0;
};

/// The unit in which the page shows a parameter: the author's, else that of the drive's angles,
/// else SI. Both arguments must outlive it.
class ShownUnits {
 public:
  ShownUnits(const DriveText& text, const WrittenDrive& written);

  ShownUnit of(const Parameter& parameter) const;

 private:
  const WrittenDrive& written_;
  std::map<std::string, std::string> texts_;  ///< of values, by their paths
};

/// Every parameter of the drive: its value, as SI and as text in its author's unit, that unit, what
/// it means, and the range of its slider.
DriveReply drive_reply(const DriveText& text, const WrittenDrive& written);

}  // namespace gearlash::web
