# NetCDF's own CMake target links every library that its own build had found, with headers that its
# Debian package does not bring. Defines NetCDF_FOUND, NetCDF_VERSION (where pkg-config knows it) and
# the target NetCDF::netcdf, the C library.

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(NetCDF_PC QUIET netcdf)
  set(NetCDF_VERSION "${NetCDF_PC_VERSION}")
endif()

find_path(NetCDF_INCLUDE_DIR netcdf.h HINTS ${NetCDF_PC_INCLUDE_DIRS})
find_library(NetCDF_LIBRARY netcdf HINTS ${NetCDF_PC_LIBRARY_DIRS})
mark_as_advanced(NetCDF_INCLUDE_DIR NetCDF_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  NetCDF
  REQUIRED_VARS NetCDF_LIBRARY NetCDF_INCLUDE_DIR
  VERSION_VAR NetCDF_VERSION
  REASON_FAILURE_MESSAGE "install NetCDF-4 with its headers (Debian: libnetcdf-dev)")

if(NetCDF_FOUND AND NOT TARGET NetCDF::netcdf)
  add_library(NetCDF::netcdf UNKNOWN IMPORTED)
  set_target_properties(
    NetCDF::netcdf PROPERTIES IMPORTED_LOCATION "${NetCDF_LIBRARY}"
                              INTERFACE_INCLUDE_DIRECTORIES "${NetCDF_INCLUDE_DIR}")
endif()
