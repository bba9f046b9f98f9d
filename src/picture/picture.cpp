#include "picture/picture.hpp"

#include <algorithm>
#include <cctype>

#include "input/units.hpp"

namespace gearlash {

PictureFormat picture_format(const std::string& field, const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".svg") return PictureFormat::svg;
  if (ending == ".png") return PictureFormat::png;
  if (ending == ".pdf") return PictureFormat::pdf;
  refuse(field, path.string(), "must end in .svg, .png or .pdf");
}

}  // namespace gearlash
