# What `cmake --install` lays down, so that another project can say
#   find_package(gearlash 0.1 CONFIG REQUIRED)                  # the numerics; needs only Eigen
#   find_package(gearlash 0.1 CONFIG REQUIRED COMPONENTS chart design io)  # also many servos at
#                                                  # once, what must change, the reader of data sheets
#   target_link_libraries(... gearlash::gearlash)  # or ::base, ::servo, ::motion, ::cycle, ::hybrid, ::drive, ::chart,
#                                                  # ::design, ::io

include(CMakePackageConfigHelpers)
set(gearlash_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/gearlash")

set(layers base servo motion cycle hybrid drive chart design)
install(TARGETS gearlash gearlash_base gearlash_servo gearlash_motion gearlash_cycle gearlash_hybrid
                gearlash_drive
        EXPORT gearlash_numerics)
install(EXPORT gearlash_numerics NAMESPACE gearlash:: FILE gearlashTargets.cmake
        DESTINATION "${gearlash_package_dir}")

# Sets of their own: users of the numerics alone need not have the packages that chart and io link.
install(TARGETS gearlash_chart gearlash_design EXPORT gearlash_chart)
install(EXPORT gearlash_chart NAMESPACE gearlash:: FILE gearlashChartTargets.cmake
        DESTINATION "${gearlash_package_dir}")

if(GEARLASH_BUILD_IO)
  list(APPEND layers io)
  install(TARGETS gearlash_io EXPORT gearlash_io)
  install(EXPORT gearlash_io NAMESPACE gearlash:: FILE gearlashIoTargets.cmake
          DESTINATION "${gearlash_package_dir}")
  install(FILES cmake/FindNetCDF.cmake cmake/FindUDUNITS2.cmake
          DESTINATION "${gearlash_package_dir}")
endif()

foreach(layer IN LISTS layers)
  install(DIRECTORY include/gearlash/${layer} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/gearlash"
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
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
