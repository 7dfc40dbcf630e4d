# SPDX-License-Identifier: Apache-2.0
#
# Installs headers, libraries, the command and a package that find_package(trisect) understands.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/trisect)

install(
    TARGETS
        trisect
        trisect_kernel
        trisect_brep
        trisect_bsp
        trisect_interference
        trisect_hierarchies
    EXPORT trisect_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
)
if(TARGET trisect_cli)
    install(TARGETS trisect_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

foreach(layer IN ITEMS kernel brep bsp)
    install(
        DIRECTORY ${PROJECT_SOURCE_DIR}/${layer}/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect/${layer}
        FILES_MATCHING
        PATTERN "*.h"
        PATTERN "trisect.h" EXCLUDE
    )
endforeach()
install(
    FILES ${PROJECT_SOURCE_DIR}/bsp/trisect.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect
    OPTIONAL
)

install(
    EXPORT trisect_targets
    NAMESPACE trisect::
    FILE trisect-targets.cmake
    DESTINATION ${package_dir}
)
configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/scripts/cmake/trisect-config.cmake.in
    ${PROJECT_BINARY_DIR}/trisect-config.cmake
    INSTALL_DESTINATION ${package_dir}
)
# Before 1.0 a minor version may break the interface.
write_basic_package_version_file(
    ${PROJECT_BINARY_DIR}/trisect-config-version.cmake COMPATIBILITY SameMinorVersion
)
install(
    FILES
        ${PROJECT_BINARY_DIR}/trisect-config.cmake
        ${PROJECT_BINARY_DIR}/trisect-config-version.cmake
        ${PROJECT_SOURCE_DIR}/scripts/cmake/trisect_dependencies.cmake
    DESTINATION ${package_dir}
)
