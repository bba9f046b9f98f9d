# gearlash_add_layer(<layer> [USES <layer>...] [OFFERS <target>...] [LINKS <target>...]
#                    [HEADER_USES <target>...])
#
# The library gearlash_<layer>, also gearlash::<layer>, of src/<layer>/*.cpp with the public headers
# of include/gearlash/<layer>.
#   USES         layers whose headers it includes; passed on to users
#   OFFERS       packages that its public headers include, so that users need them too
#   LINKS        packages that its .cpp files use and link; users of a static library link them too
#   HEADER_USES  header-only packages that only its .cpp files use: users never need them
function(gearlash_add_layer layer)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;OFFERS;LINKS;HEADER_USES")
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  set(library "gearlash_${layer}")
  set(scope PUBLIC)
  if(NOT sources)
    set(scope INTERFACE)
  endif()

  if(sources)
    add_library(${library} ${sources})
    set_target_properties(
      ${library} PROPERTIES VERSION ${PROJECT_VERSION}
                            SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    target_link_libraries(${library} PRIVATE ${arg_LINKS})
    foreach(package IN LISTS arg_HEADER_USES)
      target_link_libraries(${library} PRIVATE $<BUILD_INTERFACE:${package}>)
    endforeach()
  else()
    add_library(${library} INTERFACE)
  endif()
  add_library(gearlash::${layer} ALIAS ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${layer})

  target_compile_features(${library} ${scope} cxx_std_20)
  target_include_directories(
    ${library} ${scope}
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
    "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  list(TRANSFORM arg_USES PREPEND gearlash::)
  target_link_libraries(${library} ${scope} ${arg_USES} ${arg_OFFERS})
endfunction()
