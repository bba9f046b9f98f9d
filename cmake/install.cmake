# What `cmake --install` lays down, so that another project can say
#   find_package(gearlash 0.1 CONFIG REQUIRED)                  # the numerics
#   find_package(gearlash 0.1 CONFIG REQUIRED COMPONENTS files) # also readers, reports, pictures
#   target_link_libraries(... gearlash::gearlash)               # or gearlash::picture with them

include(CMakePackageConfigHelpers)
set(gearlash_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/gearlash")

install(TARGETS gearlash gearlash_base gearlash_numeric gearlash_model gearlash_hybrid
                gearlash_closed_form gearlash_general gearlash_analysis
        EXPORT gearlash_numerics)
install(EXPORT gearlash_numerics NAMESPACE gearlash:: FILE gearlashTargets.cmake
        DESTINATION "${gearlash_package_dir}")

# A set of their own: users of the numerics alone need not have the packages that these link.
if(GEARLASH_BUILD_IO)
  install(TARGETS gearlash_input gearlash_output gearlash_picture EXPORT gearlash_files)
  install(EXPORT gearlash_files NAMESPACE gearlash:: FILE gearlashFilesTargets.cmake
          DESTINATION "${gearlash_package_dir}")
  install(FILES cmake/FindNetCDF.cmake cmake/FindUDUNITS2.cmake
          DESTINATION "${gearlash_package_dir}")
endif()

if(TARGET gearlash_tool)
  install(TARGETS gearlash_tool)
endif()

# The headers of the rooms, until the public interface stands in include/gearlash.
install(DIRECTORY src/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/gearlash/rooms"
        FILES_MATCHING PATTERN "*.hpp")
install(FILES "${PROJECT_BINARY_DIR}/include/gearlash/version.hpp"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/gearlash")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")

configure_package_config_file(
  cmake/gearlashConfig.cmake.in "${PROJECT_BINARY_DIR}/gearlashConfig.cmake"
  INSTALL_DESTINATION "${gearlash_package_dir}")
# Below 1.0 a minor version may break its users, so 0.1 must not be taken for 0.2.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/gearlashConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/gearlashConfig.cmake"
              "${PROJECT_BINARY_DIR}/gearlashConfigVersion.cmake"
        DESTINATION "${gearlash_package_dir}")
