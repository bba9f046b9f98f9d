# NetCDF is not linked but loaded when a program writes its first file. This needs its header and
# the library's name at run time. Defines NetCDF_FOUND, NetCDF_VERSION (if pkg-config knows it),
# NetCDF_SONAME (libnetcdf.so.19), NetCDF_PACKAGE (Debian's: libnetcdf19) and the target
# NetCDF::headers.

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(NetCDF_PC QUIET netcdf)
  set(NetCDF_VERSION "${NetCDF_PC_VERSION}")
endif()

find_path(NetCDF_INCLUDE_DIR netcdf.h HINTS ${NetCDF_PC_INCLUDE_DIRS})
find_library(NetCDF_LIBRARY netcdf HINTS ${NetCDF_PC_LIBRARY_DIRS})
mark_as_advanced(NetCDF_INCLUDE_DIR NetCDF_LIBRARY)
if(NetCDF_LIBRARY AND NOT NetCDF_SONAME)
  execute_process(COMMAND "${CMAKE_OBJDUMP}" -p "${NetCDF_LIBRARY}" OUTPUT_VARIABLE library_header
                  ERROR_QUIET)
  if(library_header MATCHES "SONAME +([^ \n]+)")
    set(NetCDF_SONAME "${CMAKE_MATCH_1}" CACHE INTERNAL "name of the library at run time")
    string(REPLACE ".so." "" package "${NetCDF_SONAME}")
    set(NetCDF_PACKAGE "${package}" CACHE INTERNAL "its package")
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  NetCDF
  REQUIRED_VARS NetCDF_LIBRARY NetCDF_INCLUDE_DIR NetCDF_SONAME
  VERSION_VAR NetCDF_VERSION
  REASON_FAILURE_MESSAGE "install NetCDF-4 with its headers (Debian: libnetcdf-dev)")

if(NetCDF_FOUND AND NOT TARGET NetCDF::headers)
  add_library(NetCDF::headers INTERFACE IMPORTED)
  set_target_properties(NetCDF::headers PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
                                                   "${NetCDF_INCLUDE_DIR}")
endif()
