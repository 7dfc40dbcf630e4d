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
        trisect_csg
        trisect_interference
    EXPORT trisect_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
)
# From a file of pkg-config to the prefix, so that an installed tree can be moved.
file(
    RELATIVE_PATH TRISECT_PC_TO_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix
)
# The C interface. Programs in C need this library and its header, and nothing else of ours.
if(TARGET trisect_c)
    install(
        TARGETS trisect_c
        EXPORT trisect_targets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    )
    install(
        FILES ${PROJECT_SOURCE_DIR}/c/trisect-c/trisect.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect-c
    )
    configure_file(
        ${PROJECT_SOURCE_DIR}/scripts/cmake/trisect-c.pc.in ${PROJECT_BINARY_DIR}/trisect-c.pc @ONLY
    )
    install(
        FILES ${PROJECT_BINARY_DIR}/trisect-c.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
    )
endif()
# The library Manifold's interface, whose headers have that library's names: a folder of their own.
if(TARGET trisect_manifold)
    install(
        TARGETS trisect_manifold
        EXPORT trisect_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    )
    install(
        DIRECTORY ${PROJECT_SOURCE_DIR}/migration/manifold
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect-manifold
    )
endif()
set(TRISECT_PC_REQUIRES "")
if(TRISECT_WITH_TBB)
    set(TRISECT_PC_REQUIRES tbb)
endif()
set(TRISECT_FOUND_OF_3MF "")
set(TRISECT_PC_LIBS_3MF "")
foreach(name IN ITEMS zip expat)
    if(TARGET trisect::${name})
        list(APPEND TRISECT_FOUND_OF_3MF ${name})
        string(APPEND TRISECT_PC_LIBS_3MF " -l${name}")
    endif()
endforeach()
set(TRISECT_FOUND_OF_TEXT "")
set(TRISECT_PC_LIBS_TEXT "")
foreach(name IN ITEMS png freetype fontconfig harfbuzz)
    if(TARGET trisect::${name})
        list(APPEND TRISECT_FOUND_OF_TEXT ${name})
        string(APPEND TRISECT_PC_LIBS_TEXT " -l${name}")
    endif()
endforeach()
configure_file(
    ${PROJECT_SOURCE_DIR}/scripts/cmake/trisect.pc.in ${PROJECT_BINARY_DIR}/trisect.pc @ONLY
)
install(FILES ${PROJECT_BINARY_DIR}/trisect.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(TARGET trisect_cli)
    install(TARGETS trisect_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    if(TARGET trisect_mpi)
        install(TARGETS trisect_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    endif()
    set(manual ${PROJECT_BINARY_DIR}/manual)
    set(TRISECT_ZSH_DIR ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
        CACHE STRING "Where completion for zsh is installed, below the prefix"
    )
    install(DIRECTORY ${manual}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
    install(
        FILES ${manual}/bash/trisect
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    )
    install(FILES ${manual}/zsh/_trisect DESTINATION ${TRISECT_ZSH_DIR})
    install(
        FILES ${manual}/fish/trisect.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    )
endif()

# Headers of the public rooms (tests/layering/rooms.txt) without subfolders, but for those that only
# sources of the library include. The comparison library and its headers stay in the build tree.
set(private_headers
    brep/embedding_findings.h
    brep/curved/control_net.h
    brep/level_set/level_crossings.h
    brep/level_set/level_faces.h
    brep/level_set/level_grid.h
    brep/level_set/level_link.h
    brep/level_set/level_snap.h
    brep/level_set/level_values.h
    brep/level_set/level_vertices.h
    brep/primitives/cap.h
    brep/primitives/circle.h
    brep/mend/divide_edges.h
    brep/mend/duplicates.h
    brep/mend/exact_distance.h
    brep/mend/fill_holes.h
    brep/mend/join_vertices.h
    brep/mend/mending_mesh.h
    brep/mend/near_search.h
    brep/mend/open_edges.h
    brep/mend/orient_faces.h
    brep/mend/orient_shells.h
    brep/primitives/degrees.h
    brep/validate/checked_mesh.h
    brep/contact/contact_filter.h
    brep/validate/manifold_mesh.h
    brep/validate/oriented_box.h
    brep/validate/fans.h
    brep/validate/sheet_grid.h
    brep/validate/sheets.h
    brep/validate/shell_nesting.h
    brep/contact/triangle_contact.h
    brep/validate/triangle_tree.h
    brep/validate/twins.h
    bsp/manifold.h
    bsp/solid_of_findings.h
    bsp/csg/csg_arguments.h
    bsp/csg/csg_drawing.h
    bsp/csg/csg_evaluator.h
    bsp/csg/csg_extrude.h
    bsp/csg/csg_frame.h
    bsp/csg/csg_import.h
    bsp/csg/csg_key.h
    bsp/csg/csg_kind.h
    bsp/csg/csg_lexer.h
    bsp/csg/csg_node_progress.h
    bsp/csg/csg_program.h
    bsp/csg/csg_region.h
    bsp/csg/csg_shapes.h
    bsp/csg/nesting_level.h
    bsp/csg/grid/csg_grid_points.h
    bsp/csg/json/csg_json_scanner.h
    bsp/modelling/convex_pieces.h
    bsp/modelling/layered_walls.h
    bsp/modelling/mesh_section.h
    bsp/modelling/section_prism.h
    bsp/trisect.h
    kernel/plane_value.h
    kernel/triangle_pair.h
)
# Two headers that need nothing else: cmake --install BUILD --component predicate_suite
set(predicate_suite kernel/predicate_suite.h kernel/predicate_suite_side.h)
foreach(
    room IN
    ITEMS
        kernel
        brep
        brep/curved
        brep/interop
        brep/io
        brep/level_set
        brep/mend
        brep/primitives
        brep/validate
        bsp
        bsp/csg
        bsp/csg/grid
        bsp/csg/json
        bsp/interference
        bsp/modelling
)
    file(
        GLOB headers
        RELATIVE ${PROJECT_SOURCE_DIR}
        CONFIGURE_DEPENDS
        ${PROJECT_SOURCE_DIR}/${room}/*.h
    )
    list(REMOVE_ITEM headers ${private_headers} ${predicate_suite})
    list(TRANSFORM headers PREPEND ${PROJECT_SOURCE_DIR}/)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect/${room})
endforeach()
# The bounds that the filters of predicates.h count on.
install(
    FILES ${PROJECT_SOURCE_DIR}/kernel/number/error_bounds.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect/kernel/number
)
install(
    FILES ${predicate_suite}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect/kernel
    COMPONENT predicate_suite
    EXCLUDE_FROM_ALL
)
install(
    FILES ${PROJECT_SOURCE_DIR}/bsp/manifold.h ${PROJECT_SOURCE_DIR}/bsp/trisect.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trisect
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
