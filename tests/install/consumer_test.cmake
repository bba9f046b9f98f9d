cmake_minimum_required(VERSION 3.25)  # policies of a script run by itself

# cmake -D BUILD=... -D WORK=... -D CXX=... -D CXX_FLAGS=... -D BUILD_TYPE=... -D GENERATOR=...
#       -D COMPONENTS=... -P consumer_test.cmake
#
# Installs the build to a prefix of its own, then configures, builds and runs a consumer of it. The
# consumer is compiled as Gearlash was: sanitizers must be linked in both or in neither.

# Nothing of an earlier run may stand in for what this one fails to install.
file(REMOVE_RECURSE "${WORK}")

execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${WORK}/build"
          -G "${GENERATOR}"
          "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
          "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
          "-DGEARLASH_COMPONENTS_ASKED=${COMPONENTS}"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" COMMAND_ERROR_IS_FATAL ANY)

foreach(program IN ITEMS consumer hybrid_consumer batch_consumer design_chart_consumer
                         design_consumer)
  execute_process(COMMAND "${WORK}/build/${program}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if("files" IN_LIST COMPONENTS)
  execute_process(COMMAND "${WORK}/build/data_sheet_consumer" "${DATA_SHEET}"
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/prefix/bin/gearlash" --version COMMAND_ERROR_IS_FATAL ANY)
endif()
