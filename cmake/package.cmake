# Debian packages by `cpack -G DEB`, one for each component of install.cmake: octoblisk, the command, and
# liboctoblisk-dev. Shared libraries add liboctoblisk0.1.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR OctoBlisk)
set(CPACK_PACKAGE_CONTACT ${OCTOBLISK_PACKAGE_CONTACT})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "exact, movable concave collision shape for Bullet")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)

set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_COMPONENTS_ALL development)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and libraries: exact collision
queries on triangle meshes, and a concave shape for Bullet that may move.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liboctoblisk-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libhwy-dev, libbullet-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libbullet-extras-dev")  # world_importer.h

if(BUILD_SHARED_LIBS)
  list(APPEND CPACK_COMPONENTS_ALL libraries)
  set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS libraries)
  set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Shared libraries: exact collision
queries on triangle meshes, and a concave shape for Bullet that may move.")
  set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME liboctoblisk${soversion})
  set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_LIBRARIES_PACKAGE_GENERATE_SHLIBS ON)
endif()

if(OCTOBLISK_BUILD_DEMOS)
  list(APPEND CPACK_COMPONENTS_ALL command)
  set(CPACK_COMPONENT_COMMAND_DESCRIPTION "The command: moves a belt grinder, or any
mesh, through poses over a bladed disk and tells the intended contact from
interference.")
  set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME octoblisk)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS fonts-dejavu-core)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS gnuplot-nox)
  if(BUILD_SHARED_LIBS)
    set(CPACK_COMPONENT_COMMAND_DEPENDS libraries)
  endif()
endif()

include(CPack)
