# Debian packages by CPack: gearlash, the tool with its man pages, completions and documents;
# libgearlash-dev, the library; and, where it is built, python3-gearlash, the Python module.
# `make package` dates their contents by SOURCE_DATE_EPOCH, so that the same sources give the same
# bytes.

set(pages "${PROJECT_BINARY_DIR}/pages")
set(scripts "${PROJECT_SOURCE_DIR}/scripts")
file(MAKE_DIRECTORY "${pages}")
# Always rebuilt, because only the tool knows which man pages there are.
add_custom_target(
  pages ALL
  COMMAND "${scripts}/man-pages" "$<TARGET_FILE:gearlash_tool>" "${pages}/man1"
  COMMAND "${scripts}/completions" bash "$<TARGET_FILE:gearlash_tool>" > "${pages}/gearlash"
  COMMAND "${scripts}/completions" zsh "$<TARGET_FILE:gearlash_tool>" > "${pages}/_gearlash"
  COMMAND gzip -9n < "${PROJECT_SOURCE_DIR}/CHANGELOG.md" > "${pages}/changelog.gz"
  DEPENDS gearlash_tool
  COMMENT "Writing man pages and completions")

set(share "${CMAKE_INSTALL_DATADIR}")
install(DIRECTORY "${pages}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT tool)
install(FILES "${pages}/gearlash" DESTINATION "${share}/bash-completion/completions" COMPONENT tool)
install(FILES "${pages}/_gearlash" DESTINATION "${share}/zsh/vendor-completions" COMPONENT tool)
install(FILES README.md DESTINATION "${share}/doc/gearlash" COMPONENT tool)
install(DIRECTORY docs DESTINATION "${share}/doc/gearlash" COMPONENT tool
        FILES_MATCHING PATTERN "*.md" PATTERN pictures EXCLUDE PATTERN drawings EXCLUDE)
# The page of `gearlash explore`, which `make web` makes.
install(FILES "${PROJECT_SOURCE_DIR}/build/web/site/explorer.html" DESTINATION "${share}/gearlash"
        COMPONENT tool)
# The schemas of its JSON.
install(DIRECTORY "${PROJECT_BINARY_DIR}/schemas" DESTINATION "${share}/gearlash" COMPONENT tool)
file(GLOB drives CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/examples/*.toml")
install(FILES ${drives} DESTINATION "${share}/doc/gearlash/examples" COMPONENT tool)
set(components tool/gearlash development/libgearlash-dev)
if(TARGET gearlash_python)
  set(modules "lib/python3/dist-packages/gearlash")  # Debian's folder for any Python 3
  install(TARGETS gearlash_python LIBRARY DESTINATION "${modules}" COMPONENT python)
  install(FILES ${gearlash_python_files} DESTINATION "${modules}" COMPONENT python)
  list(APPEND components python/python3-gearlash)
endif()
set(CPACK_COMPONENTS_ALL)
foreach(pair IN LISTS components)
  cmake_path(GET pair PARENT_PATH component)
  cmake_path(GET pair FILENAME package)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(documents DESTINATION "${share}/doc/${package}" COMPONENT ${component})
  install(FILES LICENSE RENAME copyright ${documents})
  install(FILES "${pages}/changelog.gz" ${documents})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME gearlash)
set(CPACK_PACKAGE_VENDOR "The Gearlash authors")
set(CPACK_PACKAGE_CONTACT "The Gearlash authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # the first line of each description below
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
                                                GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/date_of_packages.cmake")

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME gearlash)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS ON)  # linked libraries
set(CPACK_DEBIAN_TOOL_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_TOOL_DESCRIPTION "limit cycles of geared servos with backlash
Gearlash reads a data sheet and answers whether the servo hunts, how big and
how fast, and what must change so that it does not: exactly, without a step
size to choose.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgearlash-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libfmt-dev, libnlopt-dev, libtbb-dev, libtomlplusplus-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "limit cycles of geared servos with backlash (C++ library)
Headers and static libraries of Gearlash, with its CMake package and its
pkg-config files.")

# py3compile writes the bytecode after the installation, and py3clean removes it.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-gearlash)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-xarray")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-dask, python3-distributed, python3-scipy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/python-package/postinst"
                                              "${CMAKE_CURRENT_LIST_DIR}/python-package/prerm")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "limit cycles of geared servos with backlash (Python module)
Drives as values, with NumPy arrays over the results of the C++ library: whether
a servo hunts, how big and how fast, and what must change so that it does not.")

include(CPack)
