# SPDX-License-Identifier: Apache-2.0
#
# trisect_options: how our own code is compiled. Linked privately by every target of ours, never
# installed; what a consumer must know sits on trisect_kernel instead.
add_library(trisect_options INTERFACE)
target_compile_features(trisect_options INTERFACE cxx_std_20)

# A fused multiply-add rounds once where the error bounds of the filters count two roundings.
target_compile_options(
    trisect_options
    INTERFACE
        -Wall
        -Wextra
        -Wpedantic
        -Wshadow
        -Wconversion
        -ffp-contract=off
        $<$<BOOL:${TRISECT_WERROR}>:-Werror>
        $<$<BOOL:${TRISECT_NATIVE}>:-march=x86-64-v3>
)

# GCC 12 at -O2 and above warns about overlapping copies inside its own std::string operator+
# (GCC bug 105329), whatever the caller does.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(trisect_options INTERFACE -Wno-restrict)
endif()

# Flags that everything in one program must share, the consumer test included.
set(TRISECT_INSTRUMENTATION "")
if(TRISECT_SANITIZE)
    list(APPEND TRISECT_INSTRUMENTATION -fsanitize=${TRISECT_SANITIZE} -fno-omit-frame-pointer)
    if(TRISECT_SANITIZE MATCHES "undefined")
        list(APPEND TRISECT_INSTRUMENTATION -fno-sanitize-recover=undefined)
    endif()
endif()
target_compile_options(trisect_options INTERFACE ${TRISECT_INSTRUMENTATION})
# Counts are taken in the library only (trisect_add_library); programs have to be linked for it. The
# libraries come first: of an inline function that a program compiled as well the linker keeps the
# first copy, and only the library's counts.
if(TRISECT_COVERAGE)
    list(APPEND TRISECT_INSTRUMENTATION --coverage)
    target_link_options(
        trisect_options
        INTERFACE
            "SHELL:-Wl,--whole-archive $<TARGET_FILE:trisect_hierarchies> $<TARGET_FILE:trisect_interference> $<TARGET_FILE:trisect_bsp> $<TARGET_FILE:trisect_brep> $<TARGET_FILE:trisect_kernel> -Wl,--no-whole-archive"
    )
endif()
target_link_options(trisect_options INTERFACE ${TRISECT_INSTRUMENTATION})
