# The rules of `cmake --install`. Another project then uses
#   find_package(gearlash CONFIG REQUIRED)                  # the numerics
#   find_package(gearlash CONFIG REQUIRED COMPONENTS files) # also readers, reports, pictures
#   target_link_libraries(... gearlash::gearlash)               # or gearlash::files with them
# or compile with `pkg-config --cflags --libs gearlash`, or gearlash-files.

include(CMakePackageConfigHelpers)
set(gearlash_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/gearlash")
set(gearlash_pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)  # for everything but the tool

# Writes the pkg-config file of static libraries, which are given in the order of the rooms.
function(gearlash_install_pkgconfig name)
  set(libraries ${ARGN})
  list(REVERSE libraries)  # a linker searches for missing symbols to the right
  list(TRANSFORM libraries PREPEND -l)
  list(JOIN libraries " " libraries)
  string(REGEX REPLACE "[^/]+" ".." prefix "${gearlash_pkgconfig_dir}")
  configure_file(cmake/${name}.pc.in "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${gearlash_pkgconfig_dir}")
endfunction()

set(packages_of_pc "nlopt >= 2.7")
if(GEARLASH_THREADS)
  string(APPEND packages_of_pc ", tbb >= 2021")
endif()
set(numerics gearlash_base gearlash_numeric gearlash_model gearlash_hybrid gearlash_closed_form
             gearlash_general gearlash_question)
install(TARGETS gearlash ${numerics} EXPORT gearlash_numerics)
gearlash_install_pkgconfig(gearlash ${numerics})
install(EXPORT gearlash_numerics NAMESPACE gearlash:: FILE gearlashTargets.cmake
        DESTINATION "${gearlash_package_dir}")

# A separate set, because users of the numerics alone may not have the packages that these link.
if(GEARLASH_BUILD_IO)
  set(files gearlash_input gearlash_output gearlash_picture)
  install(TARGETS gearlash_files ${files} EXPORT gearlash_files)
  gearlash_install_pkgconfig(gearlash-files ${files})
  install(EXPORT gearlash_files NAMESPACE gearlash:: FILE gearlashFilesTargets.cmake
          DESTINATION "${gearlash_package_dir}")
endif()

install(DIRECTORY include/gearlash DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.hpp")
if(TARGET gearlash_tool)
  install(TARGETS gearlash_tool COMPONENT tool)
endif()

install(FILES "${PROJECT_BINARY_DIR}/include/gearlash/version.hpp"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/gearlash")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT license)

configure_package_config_file(
  cmake/gearlashConfig.cmake.in "${PROJECT_BINARY_DIR}/gearlashConfig.cmake"
  INSTALL_DESTINATION "${gearlash_package_dir}")
# Below 1.0 a minor version may break its users: 0.3 must not satisfy a request for 0.2.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/gearlashConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/gearlashConfig.cmake"
              "${PROJECT_BINARY_DIR}/gearlashConfigVersion.cmake"
        DESTINATION "${gearlash_package_dir}")
