cmake_minimum_required(VERSION 3.25)  # policies of a script run by itself

# cmake -D BUILD=... -D WORK=... -D CXX=... -D CXX_FLAGS=... -D GENERATOR=...
#       -D COMPONENTS=... -D PROGRAMS=... -P consumer_test.cmake
#
# Installs the build to a prefix of its own, then builds and runs consumers of it, with CMake and
# with pkg-config. They are compiled as Gearlash was: sanitizers must be linked in both or in
# neither.

# Nothing of an earlier run may stand in for what this one fails to install.
file(REMOVE_RECURSE "${WORK}")

execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${WORK}/build"
          -G "${GENERATOR}"
          "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
          "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
          "-DGEARLASH_COMPONENTS_ASKED=${COMPONENTS}" "-DPROGRAMS=${PROGRAMS}"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" COMMAND_ERROR_IS_FATAL ANY)

# Nothing but the public headers is installed.
file(GLOB_RECURSE installed RELATIVE "${WORK}/prefix/include" "${WORK}/prefix/include/*")
file(GLOB public RELATIVE "${PROGRAMS}/../../include" "${PROGRAMS}/../../include/gearlash/*.hpp")
list(APPEND public gearlash/version.hpp)
list(SORT installed)
list(SORT public)
if(NOT installed STREQUAL public)
  message(FATAL_ERROR "installed headers: ${installed}\nnot: ${public}")
endif()

# Each program runs, and one with an Eigen of its own prints what another vector unit makes it print.
file(STRINGS "${WORK}/build/programs" programs)
list(APPEND programs own_eigen_native)
foreach(program IN LISTS programs)
  execute_process(COMMAND "${WORK}/build/${program}" "${DATA_SHEET}" WORKING_DIRECTORY "${WORK}"
                  OUTPUT_VARIABLE ${program}_output COMMAND_ECHO STDOUT
                  COMMAND_ERROR_IS_FATAL ANY)
  message("${${program}_output}")
endforeach()
if(NOT own_eigen_output STREQUAL own_eigen_native_output)
  message(FATAL_ERROR "with -march=native:\n${own_eigen_native_output}")
endif()

# The same without CMake, as a Makefile would.
find_program(PKG_CONFIG pkg-config REQUIRED)
file(GLOB_RECURSE found "${WORK}/prefix/gearlash.pc")
cmake_path(GET found PARENT_PATH folder)
set(consumers gearlash/consumer)
if("files" IN_LIST COMPONENTS)
  list(APPEND consumers gearlash-files/file_consumer)
endif()
foreach(consumer IN LISTS consumers)
  cmake_path(GET consumer PARENT_PATH package)
  cmake_path(GET consumer FILENAME program)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${folder}" "${PKG_CONFIG}" --cflags --libs
            ${package}
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${CXX_FLAGS} ${flags}")
  execute_process(
    COMMAND "${CXX}" -std=c++20 "${CMAKE_CURRENT_LIST_DIR}/consumer/${program}.cpp"
            -o "${WORK}/${program}" ${flags}
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/${program}" ${DATA_SHEET} COMMAND_ERROR_IS_FATAL ANY)
endforeach()

if("files" IN_LIST COMPONENTS)
  # What the program has written reads back.
  execute_process(COMMAND "${WORK}/prefix/bin/gearlash" limit-cycle "${WORK}/changed.toml" --brief
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/prefix/bin/gearlash" --version COMMAND_ERROR_IS_FATAL ANY)
endif()
