# Flags every target of the project is compiled with.
#
# -ffp-contract=off: a fused multiply-add rounds once where two operations round twice, so contraction would make
# results depend on the compiler and on the instruction set (ARCHITECTURE.md, "The same bytes everywhere").
add_library(tenon_flags INTERFACE)
target_compile_options(tenon_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                             -Wno-sign-conversion)
# GCC 12 reports the concatenation of std::string wrongly (its bug 105651).
target_compile_options(tenon_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(TENON_WERROR)
  target_compile_options(tenon_flags INTERFACE -Werror)
endif()
if(TENON_SANITIZE)
  # By default undefined behaviour is only printed, and a test in which it occurs passes.
  target_compile_options(tenon_flags INTERFACE -fsanitize=${TENON_SANITIZE} -fno-sanitize-recover=all
                                               -fno-omit-frame-pointer)
  target_link_options(tenon_flags INTERFACE -fsanitize=${TENON_SANITIZE})
  # Two instruction sets, AVX2 and plain C++, take a minute to compile with the checks in them; five take many.
  target_compile_definitions(tenon_flags
                             INTERFACE "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL)")
endif()

# tenon_module(NAME [USES module...] [LIBRARIES target...] [PRIVATE_LIBRARIES target...])
#
# One static library per folder of src/, made of every .cpp in it. USES names the folders it may include from.
function(tenon_module name)
  cmake_parse_arguments(ARG "" "" "USES;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp
       ${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp)
  if(sources)
    add_library(tenon_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(tenon_${name} PRIVATE tenon_flags ${ARG_PRIVATE_LIBRARIES})
  else()
    add_library(tenon_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(tenon_${name} ${scope} ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM ARG_USES PREPEND tenon_)
  target_link_libraries(tenon_${name} ${scope} ${ARG_USES} ${ARG_LIBRARIES})
endfunction()
