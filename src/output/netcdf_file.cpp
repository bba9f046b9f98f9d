#include "output/netcdf_file.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <netcdf.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <numeric>
#include <system_error>
#include <utility>

#include "base/lists.hpp"
#include "output/output_file.hpp"

namespace gearlash {
namespace {

/// A function of NetCDF's library. The library is loaded at the first call, because loading it and
/// the forty libraries that it needs takes longer than most commands. It is never unloaded, because
/// HDF5 does not support that. Throws OutputError if the library is missing.
void* function_of_library(const char* name) {
  static void* const library = dlopen(GEARLASH_NETCDF_SONAME, RTLD_NOW | RTLD_LOCAL);
  void* const function = library == nullptr ? nullptr : dlsym(library, name);
  if (function == nullptr) {
    throw OutputError(std::string("NetCDF files cannot be written without ") +
                      GEARLASH_NETCDF_SONAME + " (Debian: " + GEARLASH_NETCDF_PACKAGE + ")");
  }
  errno = 0;  // loading may have set it
  return function;
}

template <class Function>
struct Loaded {
  const char* name;

  template <class... Arguments>
  auto operator()(Arguments... arguments) const {
    return reinterpret_cast<Function*>(function_of_library(name))(arguments...);
  }
};

// These hide the header's declarations of the same names.
constexpr Loaded<decltype(::nc_strerror)> nc_strerror{"nc_strerror"};
constexpr Loaded<decltype(::nc_create)> nc_create{"nc_create"};
constexpr Loaded<decltype(::nc_open)> nc_open{"nc_open"};
constexpr Loaded<decltype(::nc_def_dim)> nc_def_dim{"nc_def_dim"};
constexpr Loaded<decltype(::nc_def_var)> nc_def_var{"nc_def_var"};
constexpr Loaded<decltype(::nc_def_var_chunking)> nc_def_var_chunking{"nc_def_var_chunking"};
constexpr Loaded<decltype(::nc_def_var_fill)> nc_def_var_fill{"nc_def_var_fill"};
constexpr Loaded<decltype(::nc_put_att_double)> nc_put_att_double{"nc_put_att_double"};
constexpr Loaded<decltype(::nc_put_att_schar)> nc_put_att_schar{"nc_put_att_schar"};
constexpr Loaded<decltype(::nc_put_att_text)> nc_put_att_text{"nc_put_att_text"};
constexpr Loaded<decltype(::nc_enddef)> nc_enddef{"nc_enddef"};
constexpr Loaded<decltype(::nc_redef)> nc_redef{"nc_redef"};
constexpr Loaded<decltype(::nc_inq_varid)> nc_inq_varid{"nc_inq_varid"};
constexpr Loaded<decltype(::nc_put_vara_double)> nc_put_vara_double{"nc_put_vara_double"};
constexpr Loaded<decltype(::nc_put_vara_schar)> nc_put_vara_schar{"nc_put_vara_schar"};
constexpr Loaded<decltype(::nc_get_vara_double)> nc_get_vara_double{"nc_get_vara_double"};
constexpr Loaded<decltype(::nc_get_vara_schar)> nc_get_vara_schar{"nc_get_vara_schar"};
constexpr Loaded<decltype(::nc_inq_attlen)> nc_inq_attlen{"nc_inq_attlen"};
constexpr Loaded<decltype(::nc_get_att_text)> nc_get_att_text{"nc_get_att_text"};
constexpr Loaded<decltype(::nc_sync)> nc_sync{"nc_sync"};

/// The system's reason, such as "No space left on device", is clearer than "NetCDF: HDF error". It
/// is also more exact than "Permission denied", the status of every file that HDF5 cannot create.
[[noreturn]] void refuse(const std::string& shown_name, int status, int system_error) {
  const bool is_of_the_system = status == NC_EHDFERR || status == EACCES;
  const std::string reason = is_of_the_system && system_error != 0
                                 ? std::generic_category().message(system_error)
                                 : nc_strerror(status);
  throw OutputError(shown_name + ": cannot be written: " + reason);
}

}  // namespace

template <class Call, class... Arguments>
void NetcdfFile::require(Call call, Arguments... arguments) const {
  errno = 0;
  const int status = call(id_, arguments...);
  if (status != NC_NOERR) refuse(shown_name_, status, errno);
}

template <class Call>
NetcdfFile NetcdfFile::opened(Call call, const std::filesystem::path& path, std::string shown_name,
                              int mode) {
  int id = 0;
  errno = 0;
  const int status = call(path.c_str(), mode, &id);
  if (status != NC_NOERR) refuse(shown_name, status, errno);
  return {id, path, std::move(shown_name)};
}

NetcdfFile NetcdfFile::create(const std::filesystem::path& path, std::string shown_name) {
  return opened(nc_create, path, std::move(shown_name), NC_NETCDF4 | NC_CLOBBER);
}

NetcdfFile NetcdfFile::reopen(const std::filesystem::path& path, std::string shown_name) {
  return opened(nc_open, path, std::move(shown_name), NC_WRITE);
}

NetcdfDimension NetcdfFile::add_dimension(const std::string& name, std::size_t length) {
  NetcdfDimension dimension = 0;
  require(nc_def_dim, name.c_str(), length, &dimension);
  return dimension;
}

NetcdfVariable NetcdfFile::define(const std::string& name, int type,
                                  const std::vector<NetcdfDimension>& dimensions) {
  NetcdfVariable variable = 0;
  require(nc_def_var, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(),
          &variable);
  if (!dimensions.empty()) {
    require(nc_def_var_chunking, variable, NC_CONTIGUOUS, nullptr);
    require(nc_def_var_fill, variable, NC_NOFILL, nullptr);
  }
  return variable;
}

NetcdfVariable NetcdfFile::add_numbers(const std::string& name,
                                       const std::vector<NetcdfDimension>& dimensions,
                                       const std::string& long_name, const std::string& units) {
  const NetcdfVariable variable = define(name, NC_DOUBLE, dimensions);
  set_attribute(variable, "long_name", long_name);
  set_attribute(variable, "units", units);
  return variable;
}

void NetcdfFile::declare_nan_missing(NetcdfVariable variable) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  require(nc_put_att_double, variable, "missing_value", NC_DOUBLE, std::size_t{1}, &missing);
  attributes_.push_back({variable, "missing_value", 1});
}

NetcdfVariable NetcdfFile::add_flags(const std::string& name,
                                     const std::vector<NetcdfDimension>& dimensions,
                                     const std::string& long_name,
                                     const std::vector<std::string>& meanings) {
  const NetcdfVariable variable = define(name, NC_BYTE, dimensions);
  std::vector<signed char> values(meanings.size());
  std::iota(values.begin(), values.end(), static_cast<signed char>(0));
  require(nc_put_att_schar, variable, "flag_values", NC_BYTE, values.size(), values.data());
  attributes_.push_back({variable, "flag_values", values.size()});
  set_attribute(variable, "flag_meanings", listed(meanings, std::identity(), " "));
  set_attribute(variable, "long_name", long_name);
  return variable;
}

void NetcdfFile::set_attribute(NetcdfVariable variable, const std::string& name,
                               const std::string& text) {
  require(nc_put_att_text, variable, name.c_str(), text.size(), text.c_str());
  attributes_.push_back({variable, name, text.size()});
}

void NetcdfFile::set_attribute_of_file(const std::string& name, const std::string& text) {
  set_attribute(NC_GLOBAL, name, text);
}

void NetcdfFile::end_description() {
  require(nc_enddef);
  const NetcdfFile found = opened(nc_open, path_, shown_name_, NC_NOWRITE);
  for (const Attribute& attribute : attributes_) {
    std::size_t length = 0;
    found.require(nc_inq_attlen, attribute.variable, attribute.name.c_str(), &length);
    if (length != attribute.length) refuse(shown_name_, NC_EATTMETA, 0);
  }
  attributes_.clear();
}

void NetcdfFile::resume_description() { require(nc_redef); }

NetcdfVariable NetcdfFile::variable(const std::string& name) const {
  NetcdfVariable variable = 0;
  require(nc_inq_varid, name.c_str(), &variable);
  return variable;
}

void NetcdfFile::write(NetcdfVariable variable, const NetcdfBox& box,
                       std::span<const double> values) {
  require(nc_put_vara_double, variable, box.start.data(), box.extent.data(), values.data());
}

void NetcdfFile::write(NetcdfVariable variable, const NetcdfBox& box,
                       std::span<const signed char> flags) {
  require(nc_put_vara_schar, variable, box.start.data(), box.extent.data(), flags.data());
}

void NetcdfFile::read(NetcdfVariable variable, const NetcdfBox& box,
                      std::span<double> values) const {
  require(nc_get_vara_double, variable, box.start.data(), box.extent.data(), values.data());
}

void NetcdfFile::read(NetcdfVariable variable, const NetcdfBox& box,
                      std::span<signed char> flags) const {
  require(nc_get_vara_schar, variable, box.start.data(), box.extent.data(), flags.data());
}

std::string NetcdfFile::attribute_of_file(const std::string& name) const {
  std::size_t length = 0;
  require(nc_inq_attlen, NC_GLOBAL, name.c_str(), &length);
  std::string text(length, '\0');
  require(nc_get_att_text, NC_GLOBAL, name.c_str(), text.data());
  return text;
}

void NetcdfFile::begin_flush() const {
#ifdef SYNC_FILE_RANGE_WRITE  // Linux
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  // A length of 0 stands for the whole file.
  static_cast<void>(sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE));
  ::close(descriptor);
#endif
}

void NetcdfFile::flush() {
  require(nc_sync);
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool brought = descriptor >= 0 && fsync(descriptor) == 0;
  const int system_error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!brought) refuse(shown_name_, NC_EHDFERR, system_error);
}

void NetcdfFile::close() { require(nc_sync); }

}  // namespace gearlash
