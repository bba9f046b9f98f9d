// A small NetCDF file whose variables are described together with their values.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "output/netcdf_file.hpp"

namespace gearlash {

/// Describes variables at once and writes their values after the last description.
class TwoPassFile {
 public:
  explicit TwoPassFile(NetcdfFile file) : file_(std::move(file)) {}

  NetcdfFile& file() { return file_; }

  /// Values over one dimension, or a single one without.
  NetcdfVariable add(const std::string& name, const std::vector<NetcdfDimension>& dimensions,
                     const std::string& long_name, const std::string& units,
                     std::vector<double> values) {
    std::vector<std::size_t> extent;
    if (!dimensions.empty()) extent.push_back(values.size());
    return add(name, dimensions, long_name, units, std::move(values), std::move(extent));
  }
  /// Values over dimensions of these lengths, the last fastest.
  NetcdfVariable add(const std::string& name, const std::vector<NetcdfDimension>& dimensions,
                     const std::string& long_name, const std::string& units,
                     std::vector<double> values, std::vector<std::size_t> extent) {
    const NetcdfVariable variable = file_.add_numbers(name, dimensions, long_name, units);
    numbers_.push_back({variable, std::move(extent), std::move(values)});
    return variable;
  }
  /// Numbers of words over one dimension.
  NetcdfVariable add_flags(const std::string& name, NetcdfDimension dimension,
                           const std::string& long_name, const std::vector<std::string>& meanings,
                           std::vector<signed char> flags) {
    const NetcdfVariable variable = file_.add_flags(name, {dimension}, long_name, meanings);
    flags_.push_back({variable, {flags.size()}, std::move(flags)});
    return variable;
  }

  void finish() {
    finish([](NetcdfFile&) {});
  }
  /// Also calls write_more(file), which writes what was described with file().
  template <class WriteMore>
  void finish(const WriteMore& write_more) {
    file_.end_description();
    write_more(file_);
    const auto write = [&](const auto& one) {
      if (!one.values.empty()) {
        file_.write(one.variable, std::vector<std::size_t>(one.extent.size(), 0), one.extent,
                    one.values);
      }
    };
    for (const auto& one : numbers_) write(one);
    for (const auto& one : flags_) write(one);
    file_.close();
  }

 private:
  template <class Value>
  struct Written {
    NetcdfVariable variable;
    std::vector<std::size_t> extent;
    std::vector<Value> values;
  };
  NetcdfFile file_;
  std::vector<Written<double>> numbers_;
  std::vector<Written<signed char>> flags_;
};

}  // namespace gearlash
