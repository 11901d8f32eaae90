# In a clone of the repository: vcpkg install octoblisk --overlay-ports=cmake/vcpkg. Its Bullet has single precision.
# Untried beyond its build steps.
get_filename_component(SOURCE_PATH ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
vcpkg_check_linkage(ONLY_STATIC_LIBRARY)
vcpkg_cmake_configure(SOURCE_PATH ${SOURCE_PATH} OPTIONS
  -DOCTOBLISK_BUILD_BULLET_FLOAT64=OFF
  -DOCTOBLISK_BUILD_DEMOS=OFF
  -DOCTOBLISK_BUILD_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME OctoBlisk CONFIG_PATH lib/cmake/OctoBlisk)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include ${CURRENT_PACKAGES_DIR}/debug/share)
vcpkg_install_copyright(FILE_LIST ${SOURCE_PATH}/LICENSE)
