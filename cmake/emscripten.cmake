# Toolchain of the preset "web": Debian's Emscripten, with Debian's header-only libraries.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

# Header-only libraries are those of this machine; nothing of them is compiled for it.
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY BOTH)
set(CMAKE_PREFIX_PATH /usr /usr/lib/x86_64-linux-gnu)
# Behind the headers of Emscripten's own C library, which have the same names.
set(CMAKE_CXX_FLAGS_INIT "-idirafter /usr/include")
