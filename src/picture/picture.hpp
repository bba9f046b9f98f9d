// The file formats of pictures.
#pragma once

#include <filesystem>
#include <string>

namespace gearlash {

enum class PictureFormat { svg, png, pdf };

/// The format by the file name's ending: .svg, .png or .pdf, in small or capital letters. Throws
/// InvalidInput, naming `field`, for any other.
PictureFormat picture_format(const std::string& field, const std::filesystem::path& path);

}  // namespace gearlash
