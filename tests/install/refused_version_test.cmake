# cmake -D WORK=... -D VERSION=... -D INSTALLED=... -P refused_version_test.cmake
#
# A consumer that asks for VERSION must be refused, and told which version is there.

file(REMOVE_RECURSE "${WORK}/refused-${VERSION}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${WORK}/refused-${VERSION}"
          -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX}"
          "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DGEARLASH_VERSION_ASKED=${VERSION}"
  RESULT_VARIABLE status ERROR_VARIABLE errors OUTPUT_QUIET)

if(status EQUAL 0)
  message(FATAL_ERROR "gearlash ${INSTALLED} was accepted for ${VERSION}")
endif()
string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
string(FIND "${errors}" "compatible with requested version \"${VERSION}\"" refusal)
string(FIND "${errors}" "gearlashConfig.cmake, version: ${INSTALLED}" candidate)
if(refusal EQUAL -1 OR candidate EQUAL -1)
  message(FATAL_ERROR "refused, but not for its version: ${errors}")
endif()
