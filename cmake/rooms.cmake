# gearlash_add_room(<room> [USES <room>...] [OFFERS <target>...] [LINKS <target>...]
#                   [HEADER_USES <target>...])
#
# The library gearlash_<room>, also gearlash::<room>, of src/<room> and its sub-rooms.
#   USES         rooms whose headers it includes; passed on to users
#   OFFERS       packages that its headers include, so that users of the room need them too
#   LINKS        packages that its .cpp files use and link; users of a static library link them too
#   HEADER_USES  header-only packages that only its .cpp files use: users never need them
function(gearlash_add_room room)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;OFFERS;LINKS;HEADER_USES")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.cpp")
  set(library "gearlash_${room}")
  add_library(${library} ${sources})
  add_library(gearlash::${room} ALIAS ${library})
  set_target_properties(
    ${library} PROPERTIES EXPORT_NAME ${room}
                          VERSION ${PROJECT_VERSION}
                          SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${library} PUBLIC cxx_std_20)
  target_include_directories(
    ${library} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                      "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>"
                      "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>"
                      "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>"
                      "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gearlash/rooms>")
  list(TRANSFORM arg_USES PREPEND gearlash::)
  target_link_libraries(${library} PUBLIC ${arg_USES} ${arg_OFFERS} PRIVATE ${arg_LINKS})
  foreach(package IN LISTS arg_HEADER_USES)
    target_link_libraries(${library} PRIVATE $<BUILD_INTERFACE:${package}>)
  endforeach()
endfunction()
