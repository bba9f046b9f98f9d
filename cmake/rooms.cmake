# gearlash_add_room(<room> [USES <room>...] [OFFERS <target>...] [LINKS <target>...]
#                   [HEADER_USES <target>...])
#
# Adds the library gearlash_<room>, also gearlash::<room>, of src/<room> and its sub-rooms. Rooms
# are internal: users link gearlash::gearlash or gearlash::files, which pass on neither the headers
# of rooms nor the packages that these need.
#   USES         rooms whose headers it includes
#   OFFERS       header-only packages that its headers include, so that later rooms need them too
#   LINKS        packages that its .cpp files use and link; users of a static library link them too
#   HEADER_USES  header-only packages that only its .cpp files use: users never need them
function(gearlash_add_room room)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;OFFERS;LINKS;HEADER_USES")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.cpp")
  set(library "gearlash_${room}")
  add_library(${library} ${sources})
  add_library(gearlash::${room} ALIAS ${library})
  set_target_properties(
    ${library} PROPERTIES EXPORT_NAME internal_${room}
                          VERSION ${PROJECT_VERSION}
                          SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${library} PUBLIC cxx_std_20)
  target_include_directories(
    ${library} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                      "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>"
                      "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>")
  list(TRANSFORM arg_USES PREPEND gearlash::)
  target_link_libraries(${library} PUBLIC ${arg_USES} PRIVATE ${arg_LINKS})
  foreach(package IN LISTS arg_OFFERS)
    target_link_libraries(${library} PUBLIC $<BUILD_INTERFACE:${package}>)
  endforeach()
  foreach(package IN LISTS arg_HEADER_USES)
    target_link_libraries(${library} PRIVATE $<BUILD_INTERFACE:${package}>)
  endforeach()
endfunction()

# gearlash_add_face(<library> <room>...) adds the library that users link, gearlash_<name> or
# gearlash itself. It has the public headers and links the rooms without their compile options. In
# particular, Eigen's private name must not reach the user's program.
function(gearlash_add_face library)
  add_library(${library} INTERFACE)
  target_compile_features(${library} INTERFACE cxx_std_20)
  target_include_directories(
    ${library} INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                         "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>"
                         "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  foreach(room IN LISTS ARGN)
    target_link_libraries(${library} INTERFACE $<LINK_ONLY:gearlash_${room}>)
  endforeach()
endfunction()
