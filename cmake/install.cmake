# `cmake --install` puts the command, the viewer, the rooms' libraries, their headers and a CMake package that other
# projects find by find_package(quadrille).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(rooms patches scene vectorize exporters)
list(TRANSFORM rooms PREPEND quadrille_ OUTPUT_VARIABLE room_targets)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/quadrille)

install(TARGETS quadrille)
if(QUADRILLE_VIEWER)
  install(TARGETS quadrille-view)
endif()
install(TARGETS ${room_targets} EXPORT quadrille)
foreach(room ${rooms})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()
install(EXPORT quadrille NAMESPACE quadrille:: FILE quadrilleTargets.cmake
        DESTINATION ${package_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/quadrilleConfig.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/quadrilleConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/quadrilleConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/quadrilleConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/quadrilleConfigVersion.cmake
        DESTINATION ${package_dir})
