# cmake -D AROUND=... -D WORK=... -D CXX=... -D GENERATOR=... -P around_test.cmake
#
# A project that has Gearlash in its own tree configures it in C++23 and for one thread, for which
# TBB is not looked for, and installs nothing of it.

file(REMOVE_RECURSE "${WORK}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${AROUND}" -B "${WORK}/build" -G "${GENERATOR}"
          "-DCMAKE_CXX_COMPILER=${CXX}" -DCMAKE_CXX_STANDARD=23 -DGEARLASH_BUILD_IO=ON
          -DGEARLASH_BUILD_CLI=OFF -DGEARLASH_THREADS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${WORK}/build" --prefix "${WORK}/prefix"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE installed "${WORK}/prefix/*")
if(installed)
  message(FATAL_ERROR "installed from the tree of another project: ${installed}")
endif()
