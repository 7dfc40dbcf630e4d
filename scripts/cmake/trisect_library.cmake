# SPDX-License-Identifier: Apache-2.0

# trisect_add_library(<layer>): the static library trisect_<layer>, known to users as
# trisect::<layer>, in the build tree and installed.
function(trisect_add_library layer)
    set(target trisect_${layer})
    add_library(${target} STATIC)
    add_library(trisect::${layer} ALIAS ${target})
    set_target_properties(
        ${target} PROPERTIES EXPORT_NAME ${layer} POSITION_INDEPENDENT_CODE ON
    )
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(
        ${target}
        PUBLIC
            $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    )
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:trisect_options>)
    # Libraries are compiled as parts of shared ones, in which g++, other than clang, inlines no
    # function that another library might replace.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    endif()
    if(TRISECT_COVERAGE)
        target_compile_options(${target} PRIVATE -O0 --coverage)
        # Nothing else is compiled anew in such a build; reading these was half of the time.
        target_precompile_headers(
            ${target} PRIVATE
            <algorithm> <array> <bit> <cmath> <compare> <concepts> <cstdint> <functional> <limits>
            <map> <memory> <mutex> <numeric> <optional> <span> <string> <thread> <tuple>
            <unordered_map> <utility> <variant> <vector>
        )
    endif()
endfunction()

# trisect_add_subfolders(<folder>...): enters folders, all of which must exist: what is left out in
# silence is missed by nobody, a folder of tests least of all.
function(trisect_add_subfolders)
    foreach(folder IN LISTS ARGN)
        if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/CMakeLists.txt)
            message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${folder} has no CMakeLists.txt")
        endif()
        add_subdirectory(${folder})
    endforeach()
endfunction()

# trisect_allow_empty(<target>): gives a library that has no source yet an empty one.
function(trisect_allow_empty target)
    get_target_property(sources ${target} SOURCES)
    if(NOT sources)
        set(empty ${CMAKE_CURRENT_BINARY_DIR}/${target}_empty.cpp)
        file(WRITE ${empty} "")
        target_sources(${target} PRIVATE ${empty})
    endif()
endfunction()
