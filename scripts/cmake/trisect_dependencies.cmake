# SPDX-License-Identifier: Apache-2.0
#
# What the static libraries need when something links against them. The build of Trisect and the
# installed package both include this file, so the two cannot drift apart.
include(CMakeFindDependencyMacro)

find_dependency(Threads)
# What targets that use threads link: oneTBB, or nothing.
set(trisect_threads "")
if(TRISECT_WITH_TBB)
    find_dependency(TBB)
    set(trisect_threads TBB::tbb)
endif()

# GMP ships no CMake package. Its headers stay inside our .cpp files; consumers only link.
if(NOT TARGET trisect::gmp)
    find_library(TRISECT_GMP_LIBRARY gmp)
    find_path(TRISECT_GMP_INCLUDE_DIR gmp.h)
    mark_as_advanced(TRISECT_GMP_LIBRARY TRISECT_GMP_INCLUDE_DIR)
    if(TRISECT_GMP_LIBRARY AND TRISECT_GMP_INCLUDE_DIR)
        add_library(trisect::gmp UNKNOWN IMPORTED)
        set_target_properties(
            trisect::gmp
            PROPERTIES
                IMPORTED_LOCATION "${TRISECT_GMP_LIBRARY}"
                INTERFACE_INCLUDE_DIRECTORIES "${TRISECT_GMP_INCLUDE_DIR}"
        )
    elseif(CMAKE_FIND_PACKAGE_NAME STREQUAL "trisect")
        set(trisect_FOUND FALSE)
        set(trisect_NOT_FOUND_MESSAGE "Trisect needs GMP (Debian: libgmp-dev)")
        return()
    else()
        message(FATAL_ERROR "Trisect needs GMP (Debian: libgmp-dev, or run scripts/install-deps)")
    endif()
endif()

# 3MF and AMF take libzip and expat; a build that does not find them refuses these formats by name. An
# installed package names those that it was built with.
if(NOT DEFINED TRISECT_LIBRARIES_OF_3MF)
    set(TRISECT_LIBRARIES_OF_3MF "")
    if(TRISECT_WITH_3MF AND NOT TRISECT_FEW_COMMANDS)
        set(TRISECT_LIBRARIES_OF_3MF zip expat)
    endif()
endif()
foreach(name IN LISTS TRISECT_LIBRARIES_OF_3MF)
    if(TARGET trisect::${name})
        continue()
    endif()
    string(TOUPPER ${name} upper)
    find_library(TRISECT_${upper}_LIBRARY ${name})
    find_path(TRISECT_${upper}_INCLUDE_DIR ${name}.h)
    mark_as_advanced(TRISECT_${upper}_LIBRARY TRISECT_${upper}_INCLUDE_DIR)
    if(TRISECT_${upper}_LIBRARY AND TRISECT_${upper}_INCLUDE_DIR)
        add_library(trisect::${name} UNKNOWN IMPORTED)
        set_target_properties(
            trisect::${name}
            PROPERTIES
                IMPORTED_LOCATION "${TRISECT_${upper}_LIBRARY}"
                INTERFACE_INCLUDE_DIRECTORIES "${TRISECT_${upper}_INCLUDE_DIR}"
        )
    elseif(CMAKE_FIND_PACKAGE_NAME STREQUAL "trisect")
        set(trisect_FOUND FALSE)
        set(trisect_NOT_FOUND_MESSAGE "Trisect was built with ${name} (Debian: libzip-dev, libexpat1-dev)")
        return()
    endif()
endforeach()

# Programs of OpenSCAD take text by FreeType, fontconfig and HarfBuzz, and pictures by libpng. A build that
# does not find them refuses both by name.
if(NOT DEFINED TRISECT_LIBRARIES_OF_TEXT)
    set(TRISECT_LIBRARIES_OF_TEXT "")
    if(TRISECT_WITH_TEXT AND NOT TRISECT_FEW_COMMANDS)
        set(TRISECT_LIBRARIES_OF_TEXT png freetype fontconfig harfbuzz)
    endif()
endif()
set(TRISECT_HEADER_png png.h)
set(TRISECT_HEADER_freetype ft2build.h)
set(TRISECT_HEADER_fontconfig fontconfig/fontconfig.h)
set(TRISECT_HEADER_harfbuzz hb-ft.h)
foreach(name IN LISTS TRISECT_LIBRARIES_OF_TEXT)
    if(TARGET trisect::${name})
        continue()
    endif()
    string(TOUPPER ${name} upper)
    find_library(TRISECT_${upper}_LIBRARY ${name})
    find_path(TRISECT_${upper}_INCLUDE_DIR ${TRISECT_HEADER_${name}} PATH_SUFFIXES freetype2 harfbuzz)
    mark_as_advanced(TRISECT_${upper}_LIBRARY TRISECT_${upper}_INCLUDE_DIR)
    if(TRISECT_${upper}_LIBRARY AND TRISECT_${upper}_INCLUDE_DIR)
        add_library(trisect::${name} UNKNOWN IMPORTED)
        set_target_properties(
            trisect::${name}
            PROPERTIES
                IMPORTED_LOCATION "${TRISECT_${upper}_LIBRARY}"
                INTERFACE_INCLUDE_DIRECTORIES "${TRISECT_${upper}_INCLUDE_DIR}"
        )
    elseif(CMAKE_FIND_PACKAGE_NAME STREQUAL "trisect")
        set(trisect_FOUND FALSE)
        set(trisect_NOT_FOUND_MESSAGE
            "Trisect was built with ${name} (Debian: libpng-dev, libfreetype-dev, libfontconfig-dev, libharfbuzz-dev)"
        )
        return()
    endif()
endforeach()
