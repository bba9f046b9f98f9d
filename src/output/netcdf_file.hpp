// A NetCDF-4 file being written: dimensions, variables and attributes by name, errors thrown.
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

/// Every member throws OutputError, naming the file as `shown_name`, where the library refuses
/// (disk full, no permission, a file of another layout).
class NetcdfFile {
 public:
  /// A new file, or an empty one, to be described and then filled.
  static NetcdfFile create(const std::filesystem::path& path, std::string shown_name);
  /// A file that was created here, to be filled further.
  static NetcdfFile reopen(const std::filesystem::path& path, std::string shown_name);
  ~NetcdfFile();
  NetcdfFile(NetcdfFile&& other) noexcept;
  NetcdfFile& operator=(NetcdfFile&&) = delete;

  // Description, before the first values, or after resume_description().
  NetcdfDimension add_dimension(const std::string& name, std::size_t length);
  /// Doubles; one number without dimensions. Values are stored without gaps in the order of the
  /// indices: the file does not depend on the pieces in which it is written.
  NetcdfVariable add_numbers(const std::string& name,
                             const std::vector<NetcdfDimension>& dimensions,
                             const std::string& long_name, const std::string& units);
  /// Of numbers: that NaN stands for none. (Of coordinates there are all.)
  void declare_nan_missing(NetcdfVariable variable);
  /// Whole numbers from 0 on that stand for words (the conventions' "flags").
  NetcdfVariable add_flags(const std::string& name, const std::vector<NetcdfDimension>& dimensions,
                           const std::string& long_name, const std::vector<std::string>& meanings);
  void set_attribute(NetcdfVariable variable, const std::string& name, const std::string& text);
  void set_attribute_of_file(const std::string& name, const std::string& text);
  void end_description();
  void resume_description();

  NetcdfVariable variable(const std::string& name) const;
  /// The values of a box of indices, the last index fastest.
  void write(NetcdfVariable variable, const std::vector<std::size_t>& start,
             const std::vector<std::size_t>& extent, std::span<const double> values);
  void write(NetcdfVariable variable, const std::vector<std::size_t>& start,
             const std::vector<std::size_t>& extent, std::span<const signed char> flags);

  // What was written, read back.
  void read(NetcdfVariable variable, const std::vector<std::size_t>& start,
            const std::vector<std::size_t>& extent, std::span<double> values) const;
  void read(NetcdfVariable variable, const std::vector<std::size_t>& start,
            const std::vector<std::size_t>& extent, std::span<signed char> flags) const;
  std::string attribute_of_file(const std::string& name) const;

  /// Lets the system begin to bring to the disk what was written, and does not wait for it: what
  /// is left to flush(), or to another fsync, is then short. No more than an advice.
  void begin_flush() const;
  /// Brings everything to the disk (fsync).
  void flush();
  void close();

 private:
  NetcdfFile(int id, std::filesystem::path path, std::string shown_name)
      : id_(id), path_(std::move(path)), shown_name_(std::move(shown_name)) {}

  template <class Call, class... Arguments>
  void require(Call call, Arguments... arguments) const;

  NetcdfVariable define(const std::string& name, int type,
                        const std::vector<NetcdfDimension>& dimensions);

  int id_;  ///< the library's; negative when closed
  std::filesystem::path path_;
  std::string shown_name_;
};

}  // namespace gearlash
