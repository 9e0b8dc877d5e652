# Settings of every target: language, warnings, floating point, sanitizers.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  # ccache needs the sloppiness to reuse what was built with a precompiled header, and paths relative to the project to reuse in one build
  # folder what another made: the program without a window is mostly the same objects.
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
    CCACHE_NOHASHDIR=1 ${CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()

# Linked by every target of the project. -ffp-contract=off gives the same bits on every processor: fma is used only where the code says so.
add_library(dmoscope_settings INTERFACE)
target_compile_options(dmoscope_settings INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wshadow -Wconversion -ffp-contract=off>)
target_include_directories(dmoscope_settings INTERFACE ${PROJECT_SOURCE_DIR})
# Resolves all symbols of shared libraries at start and makes the table of them read-only.
target_link_options(dmoscope_settings INTERFACE -Wl,-z,relro,-z,now)
# Drops libraries that no code uses.
target_link_options(dmoscope_settings INTERFACE LINKER:--as-needed)
if(DMOSCOPE_SANITIZE)
  set(fewer_checks "")
  if(DMOSCOPE_SANITIZE MATCHES "address")
    # Leaves out the checks that run at every access to memory and keep functions from being inlined: they take a third of the time, and
    # AddressSanitizer finds most of the same faults. The readers, which parse untrusted bytes, keep them.
    set(fewer_checks $<$<NOT:$<STREQUAL:$<TARGET_PROPERTY:NAME>,dmoscope_io>>:-fno-sanitize=null,alignment,object-size,vptr,pointer-overflow>)
  endif()
  # With a sanitizer g++ warns of variables that are set (see its manual).
  target_compile_options(dmoscope_settings INTERFACE -fsanitize=${DMOSCOPE_SANITIZE} ${fewer_checks} -fno-omit-frame-pointer
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-maybe-uninitialized>)
  target_link_options(dmoscope_settings INTERFACE -fsanitize=${DMOSCOPE_SANITIZE})
  if(DMOSCOPE_SANITIZE MATCHES "address" AND DMOSCOPE_GUI)
    add_library(dmoscope_keep_loaded OBJECT ${CMAKE_CURRENT_LIST_DIR}/keep_loaded.c)
    target_link_libraries(dmoscope_settings INTERFACE $<TARGET_OBJECTS:dmoscope_keep_loaded>)
    target_link_options(dmoscope_settings INTERFACE -Wl,--export-dynamic-symbol=dlclose)
  endif()
endif()
# Optimisation of targets that have no inner loops but many templates: optimising these takes most of the compiler's time, and with
# AddressSanitizer twice as long as not optimising them.
set(DMOSCOPE_COLD_CODE -O1)
set(DMOSCOPE_DRAWING_CODE -O1)  # of the window's modules: the libraries that they call do the work
set(DMOSCOPE_LOGIC_CODE -O2)     # of what the window shows: loops over all elements, which people wait for
if(DMOSCOPE_SANITIZE MATCHES "address")
  set(DMOSCOPE_COLD_CODE -O0)
  set(DMOSCOPE_DRAWING_CODE -O0)
  set(DMOSCOPE_LOGIC_CODE -O0)
endif()
if(DMOSCOPE_PORTABLE)
  # Links libstdc++ statically: a bundled one could be too old for the machine's drivers, which share it with the program. Uses RPATH, not
  # RUNPATH, which does not apply to the dependencies of bundled libraries.
  target_link_options(dmoscope_settings INTERFACE -static-libstdc++ -static-libgcc -Wl,--disable-new-dtags)
  set(CMAKE_INSTALL_RPATH "$ORIGIN/../lib")
  set(CMAKE_BUILD_WITH_INSTALL_RPATH ON)
endif()

# Neighbouring sources of a module are compiled together, which takes a quarter of the time: most of it goes into headers. So what is in a
# source's anonymous namespace is named apart from what its neighbours have there. -DCMAKE_UNITY_BUILD=OFF compiles each for itself.
if(NOT DEFINED CMAKE_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
endif()
set(CMAKE_UNITY_BUILD_BATCH_SIZE 10)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ takes a source that is compiled with others for a header, in which an anonymous namespace would be a mistake.
  target_compile_options(dmoscope_settings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()

# Ends the program at overflows of buffers on the stack, and of those whose size the C library knows. Left out for the search's kernels
# (core/CMakeLists.txt) and under sanitizers, which find more.
set(DMOSCOPE_HARDENED "")
if(NOT DMOSCOPE_SANITIZE AND CMAKE_BUILD_TYPE STREQUAL "Release")
  set(DMOSCOPE_HARDENED -fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
endif()

# Precompiled headers: those of other projects that most sources include. Every source still includes what it uses:
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without them.
set(DMOSCOPE_PRECOMPILED <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <span> <string> <string_view>
  <vector> <fmt/format.h>)

# dmoscope_module(NAME [FOLDER...]): a static library of all sources below the folders, or below the current one.
function(dmoscope_module name)
  set(patterns *.cpp *.h)
  if(ARGN)
    list(TRANSFORM ARGN APPEND /*.cpp OUTPUT_VARIABLE patterns)
    list(TRANSFORM ARGN APPEND /*.h OUTPUT_VARIABLE headers)
    list(APPEND patterns ${headers})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC dmoscope_settings)
  # Modules are part of the shared library, too, which shows nothing but what its headers say.
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:${DMOSCOPE_HARDENED}>)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")  # in g++'s, libstdc++ loses what keeps g++ from warning of it where it optimises
    target_precompile_headers(${name} PRIVATE ${DMOSCOPE_PRECOMPILED})
  endif()
endfunction()
