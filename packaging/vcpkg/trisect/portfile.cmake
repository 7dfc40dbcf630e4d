# SPDX-License-Identifier: Apache-2.0
#
# vcpkg port of Trisect, an overlay port: vcpkg install trisect --overlay-ports=packaging/vcpkg
# It builds the clone that it is in.
vcpkg_check_linkage(ONLY_STATIC_LIBRARY)
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES tbb TRISECT_WITH_TBB)
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${features}
        -DTRISECT_BATCHES=ON
        -DTRISECT_INSTALL=ON
        -DTRISECT_BUILD_APPS=OFF
        -DTRISECT_BUILD_TESTS=OFF
        -DTRISECT_BUILD_EXAMPLES=OFF
        -DTRISECT_BUILD_C=OFF
        -DTRISECT_BUILD_MANIFOLD=OFF
        -DTRISECT_WITH_3MF=OFF
        -DTRISECT_WITH_TEXT=OFF
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME trisect CONFIG_PATH lib/cmake/trisect)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
