# Options that every target of the project shares, and none that uses it from outside.
add_library(supple_options INTERFACE)
target_compile_options(supple_options INTERFACE -Wall -Wextra -Werror -ffp-contract=off)
# g++ 12 sees overruns in std::string that are not there (GCC bug 105651); clang keeps looking.
target_compile_options(supple_options INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread>)
target_include_directories(supple_options INTERFACE ${PROJECT_SOURCE_DIR})

if(SUPPLE_SANITIZE)
  target_compile_options(supple_options INTERFACE
    -fsanitize=${SUPPLE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(supple_options INTERFACE -fsanitize=${SUPPLE_SANITIZE})
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()
