# cmake -D SOURCE=... -D WORK=... -D CXX=... -D GENERATOR=... -P subproject_test.cmake
#
# A project that has Gearlash in its own tree keeps its targets as they were, compiles programs with
# it in C++23 with warnings as errors, and installs nothing of Gearlash. Gearlash itself is not
# built: installing would miss what is not there. It works on one thread, for which TBB is
# not looked for.

file(REMOVE_RECURSE "${WORK}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/parent" -B "${WORK}/build"
          -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX}" "-DGEARLASH=${SOURCE}"
          -DGEARLASH_THREADS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" --target programs
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE built "${WORK}/build/*.a")
if(built)
  message(FATAL_ERROR "built for programs that need headers alone: ${built}")
endif()
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${WORK}/build" --prefix "${WORK}/prefix"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE installed "${WORK}/prefix/*")
if(installed)
  message(FATAL_ERROR "installed from the tree of another project: ${installed}")
endif()
