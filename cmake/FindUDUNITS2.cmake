# UDUNITS-2 comes without a CMake package. Defines
#   UDUNITS2_FOUND, UDUNITS2_VERSION (where pkg-config knows it) and the target UDUNITS2::udunits2.

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(UDUNITS2_PC QUIET udunits)
  set(UDUNITS2_VERSION "${UDUNITS2_PC_VERSION}")
endif()

find_path(UDUNITS2_INCLUDE_DIR udunits2.h HINTS ${UDUNITS2_PC_INCLUDE_DIRS}
          PATH_SUFFIXES udunits2)  # Fedora's place
find_library(UDUNITS2_LIBRARY udunits2 HINTS ${UDUNITS2_PC_LIBRARY_DIRS})
mark_as_advanced(UDUNITS2_INCLUDE_DIR UDUNITS2_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  UDUNITS2
  REQUIRED_VARS UDUNITS2_LIBRARY UDUNITS2_INCLUDE_DIR
  VERSION_VAR UDUNITS2_VERSION
  REASON_FAILURE_MESSAGE "install UDUNITS-2 with its headers (Debian: libudunits2-dev)")

if(UDUNITS2_FOUND AND NOT TARGET UDUNITS2::udunits2)
  add_library(UDUNITS2::udunits2 UNKNOWN IMPORTED)
  set_target_properties(
    UDUNITS2::udunits2 PROPERTIES IMPORTED_LOCATION "${UDUNITS2_LIBRARY}"
                                  INTERFACE_INCLUDE_DIRECTORIES "${UDUNITS2_INCLUDE_DIR}")
endif()
