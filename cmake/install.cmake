# What `cmake --install` puts where, in two components: `command`, the octoblisk command alone, and `development`, all
# that a program needs that uses core or plugin: headers, libraries, CMake package, pkg-config files. Shared libraries
# are a component of their own, `libraries`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/OctoBlisk)
file(RELATIVE_PATH prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)

# octoblisk_install(TARGET DESCRIPTION REQUIRES LIBS): a library with the targets file and the .pc file for it; these
# tell which packages, and libraries beside, a program has to link.
function(octoblisk_install library description requires libs)
  get_target_property(export_name ${library} EXPORT_NAME)
  install(TARGETS ${library} EXPORT OctoBlisk_${export_name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT OctoBlisk_${export_name} NAMESPACE OctoBlisk:: DESTINATION ${package_dir} COMPONENT development)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/octoblisk.pc.in ${PROJECT_BINARY_DIR}/${library}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${library}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()

# A shared library brings what it is made of; who links a static one links that too.
if(BUILD_SHARED_LIBS)
  octoblisk_install(octoblisk-core "Exact queries on triangle meshes by a clustered octree" "eigen3" "")
else()
  octoblisk_install(octoblisk-core "Exact queries on triangle meshes by a clustered octree" "eigen3 libhwy" "-pthread")
endif()
if(OCTOBLISK_BUILD_BULLET)
  octoblisk_install(octoblisk-bullet "An exact, movable concave collision shape for Bullet" "octoblisk-core bullet" "")
endif()
if(OCTOBLISK_BUILD_BULLET_FLOAT64)
  octoblisk_install(octoblisk-bullet-float64 "An exact, movable concave collision shape for Bullet in double precision"
    "octoblisk-core bullet-float64" "")
endif()

if(OCTOBLISK_BUILD_DEMOS)
  if(BUILD_SHARED_LIBS)
    set_target_properties(octoblisk PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR})
  endif()
  install(TARGETS octoblisk RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/OctoBliskConfig.cmake.in
  ${PROJECT_BINARY_DIR}/OctoBliskConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/OctoBliskConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/OctoBliskConfig.cmake ${PROJECT_BINARY_DIR}/OctoBliskConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/OctoBliskBulletPhysics.cmake
  DESTINATION ${package_dir} COMPONENT development)
