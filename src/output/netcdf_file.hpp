// Files in NetCDF's classic format: numbers and flags over named dimensions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gearlash {

struct NetcdfDimension {
  std::string name;
  std::size_t length;  ///< not 0
};

struct NetcdfAttribute {
  std::string name;
  std::variant<std::string, double, std::vector<signed char>> value;
};

enum class NetcdfType : std::uint8_t { flags = 1, text = 2, numbers = 6 };  ///< as in the file

struct NetcdfVariable {
  std::string name;
  NetcdfType type;                      ///< no text
  std::vector<std::size_t> dimensions;  ///< their indices, the last fastest; empty for one value
  std::vector<NetcdfAttribute> attributes;
  std::vector<double> values = {};  ///< known from the beginning; else empty
};

struct NetcdfDescription {
  std::vector<NetcdfDimension> dimensions;
  std::vector<NetcdfAttribute> attributes;  ///< of the file
  std::vector<NetcdfVariable> variables;    ///< those with values first
};

/// In bytes: the largest variable of version 2 of the format, in which lengths have 32 bits and
/// which more programs read than version 5.
inline constexpr std::size_t largest_of_version_2 = 0xFFFF'FFFB;

/// What such a file begins with, and where the values of each variable are. They follow one another
/// in the order of the description.
struct NetcdfLayout {
  std::string head;  ///< the header, zeros up to the first value, and the values that are known
  std::size_t header_bytes;
  std::vector<std::pair<std::string, std::size_t>> places;  ///< of the first values, by name
  std::size_t end;                                          ///< of all values
};
/// The values begin at byte `begin` of the file, at the end of the header or later. A variable
/// beyond `largest` makes it one of version 5. The format: Unidata, "NetCDF Classic Format
/// Specification"; Northwestern University, "CDF-5 Format Specification".
NetcdfLayout layout_of(const NetcdfDescription& description, std::size_t begin,
                       std::size_t largest = largest_of_version_2);

/// Every member throws OutputError, naming the file as `shown_name` and the system's reason, if the
/// system reports an error. Nothing is buffered. The descriptor, open to read and write, is the
/// caller's and outlives this object.
class NetcdfFile {
 public:
  /// Makes the file anew, with room on the disk for all values, which are 0.
  static NetcdfFile create(int descriptor, std::string shown_name, NetcdfLayout layout);
  /// Opens a file of the same layout. Throws OutputError also if its head or length is another.
  static NetcdfFile reopen(int descriptor, std::string shown_name, NetcdfLayout layout);
  /// Adds variables: `layout` begins with the places of the present one.
  void extend(NetcdfLayout layout);

  /// Writes values of a variable of numbers or flags, from value number `first` on.
  void write(std::string_view variable, std::size_t first, std::span<const double> numbers);
  void write(std::string_view variable, std::size_t first, std::span<const std::byte> flags);
  void read(std::string_view variable, std::size_t first, std::span<double> numbers) const;
  void read(std::string_view variable, std::size_t first, std::span<std::byte> flags) const;
  /// Brings everything to the disk (fsync).
  void flush();

 private:
  NetcdfFile(int descriptor, std::string shown_name, NetcdfLayout layout)
      : descriptor_(descriptor), shown_name_(std::move(shown_name)), layout_(std::move(layout)) {}

  void begin();
  void put(std::span<const std::byte> bytes, std::size_t place);
  void get(std::span<std::byte> bytes, std::size_t place) const;
  std::size_t place_of(std::string_view variable) const;
  [[noreturn]] void refuse(const char* action) const;

  int descriptor_;
  std::string shown_name_;
  NetcdfLayout layout_;
};

}  // namespace gearlash
