# The files of `cmake --install` in two components. `command` is only the octoblisk command. `development` is everything
# that a program with core or plugin needs: headers, libraries, CMake package, pkg-config files. Shared libraries are a
# third component, `libraries`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/OctoBlisk)
file(RELATIVE_PATH prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)

# octoblisk_install(TARGET DESCRIPTION REQUIRES LIBS): installs a library with its targets file and .pc file. REQUIRES
# and LIBS are the packages and further libraries that a program must link.
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

# A program that links a static library must also link the library's dependencies. A shared library brings them along.
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
