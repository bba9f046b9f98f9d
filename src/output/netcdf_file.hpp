// Writing a NetCDF-4 file: dimensions, variables and attributes by name, errors as exceptions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gearlash {

/// Identifiers of the NetCDF library.
using NetcdfDimension = int;
using NetcdfVariable = int;

/// A box of indices: its start and extent in each dimension.
struct NetcdfBox {
  std::vector<std::size_t> start;
  std::vector<std::size_t> extent;
};

/// Every member throws OutputError, naming the file as `shown_name`, if the library reports an
/// error (disk full, no permission, a file of another layout).
///
/// The library's own file stays open, because HDF5 (1.10.8) crashes as it closes a file if the last
/// write fails, and at the end of a program in which any write has failed. So the program ends by
/// _exit. The library's close would only add the mark that the file is closed, which readers do not
/// need.
class NetcdfFile {
 public:
  /// Makes a new file, or opens an empty one, to be described and then filled.
  static NetcdfFile create(const std::filesystem::path& path, std::string shown_name);
  /// Reopens a file of create() to fill it further.
  static NetcdfFile reopen(const std::filesystem::path& path, std::string shown_name);
  NetcdfFile(NetcdfFile&&) = default;

  // The description comes before the first values or after resume_description().
  NetcdfDimension add_dimension(const std::string& name, std::size_t length);
  /// A variable of doubles; without dimensions a single number. Values are stored contiguously in
  /// the order of the indices, so that the file does not depend on how the writing is divided.
  NetcdfVariable add_numbers(const std::string& name,
                             const std::vector<NetcdfDimension>& dimensions,
                             const std::string& long_name, const std::string& units);
  /// Declares NaN as the missing value of a variable of numbers. Coordinates need none: all are
  /// known.
  void declare_nan_missing(NetcdfVariable variable);
  /// A variable of whole numbers from 0 on that stand for words (the CF conventions' "flags").
  NetcdfVariable add_flags(const std::string& name, const std::vector<NetcdfDimension>& dimensions,
                           const std::string& long_name, const std::vector<std::string>& meanings);
  void set_attribute(NetcdfVariable variable, const std::string& name, const std::string& text);
  void set_attribute_of_file(const std::string& name, const std::string& text);
  /// Also reads back which attributes there are: the library leaves out those for which it has no
  /// memory, and reports success.
  void end_description();
  void resume_description();

  NetcdfVariable variable(const std::string& name) const;
  /// Writes the values of a box, the last index fastest.
  void write(NetcdfVariable variable, const NetcdfBox& box, std::span<const double> values);
  void write(NetcdfVariable variable, const NetcdfBox& box, std::span<const signed char> flags);

  // Reads values back.
  void read(NetcdfVariable variable, const NetcdfBox& box, std::span<double> values) const;
  void read(NetcdfVariable variable, const NetcdfBox& box, std::span<signed char> flags) const;
  std::string attribute_of_file(const std::string& name) const;

  /// Advises the system to begin writing to the disk, without waiting. This shortens a later
  /// flush() or fsync.
  void begin_flush() const;
  /// Writes everything to the disk (fsync).
  void flush();
  /// Writes everything to the file.
  void close();

 private:
  NetcdfFile(int id, std::filesystem::path path, std::string shown_name)
      : id_(id), path_(std::move(path)), shown_name_(std::move(shown_name)) {}

  template <class Call>
  static NetcdfFile opened(Call call, const std::filesystem::path& path, std::string shown_name,
                           int mode);

  template <class Call, class... Arguments>
  void require(Call call, Arguments... arguments) const;

  NetcdfVariable define(const std::string& name, int type,
                        const std::vector<NetcdfDimension>& dimensions);

  struct Attribute {
    NetcdfVariable variable;
    std::string name;
    std::size_t length;
  };

  int id_;  ///< the library's identifier
  std::filesystem::path path_;
  std::string shown_name_;
  std::vector<Attribute> attributes_{};  ///< set since the last end_description()
};

}  // namespace gearlash
