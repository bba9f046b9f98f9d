cmake_minimum_required(VERSION 3.25)  # policies of a script run by itself

# cmake -D BUILD=... -D WORK=... -D CXX=... -D CXX_FLAGS=... -D BUILD_TYPE=... -D GENERATOR=...
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
          "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
          "-DGEARLASH_COMPONENTS_ASKED=${COMPONENTS}" "-DPROGRAMS=${PROGRAMS}"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" COMMAND_ERROR_IS_FATAL ANY)

foreach(program IN ITEMS consumer hybrid_consumer batch_consumer design_chart_consumer
                         design_consumer)
  execute_process(COMMAND "${WORK}/build/${program}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# The same without CMake, as a Makefile would.
find_program(PKG_CONFIG pkg-config REQUIRED)
file(GLOB_RECURSE found "${WORK}/prefix/gearlash.pc")
cmake_path(GET found PARENT_PATH folder)
set(consumers gearlash/consumer)
if("files" IN_LIST COMPONENTS)
  list(APPEND consumers gearlash-files/data_sheet_consumer)
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
  execute_process(COMMAND "${WORK}/build/data_sheet_consumer" "${DATA_SHEET}"
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/build/sensor_place" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/build/sweep" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/build/change_file" "${DATA_SHEET}"
                  WORKING_DIRECTORY "${WORK}" COMMAND_ERROR_IS_FATAL ANY)
  # What the program has written reads back.
  execute_process(COMMAND "${WORK}/prefix/bin/gearlash" limit-cycle "${WORK}/changed.toml" --brief
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/prefix/bin/gearlash" --version COMMAND_ERROR_IS_FATAL ANY)
endif()
