# Bullet's libraries as targets, one for each precision where it is there: OctoBlisk::bullet_physics and
# OctoBlisk::bullet_physics_float64. Read by the build and, installed, by find_package(OctoBlisk).
find_path(OCTOBLISK_BULLET_INCLUDE_DIR BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h
  PATH_SUFFIXES bullet)
mark_as_advanced(OCTOBLISK_BULLET_INCLUDE_DIR)

function(octoblisk_bullet_physics target bullet_suffix)
  if(TARGET ${target} OR NOT OCTOBLISK_BULLET_INCLUDE_DIR)
    return()
  endif()
  set(files)
  foreach(library BulletSoftBody BulletDynamics BulletCollision LinearMath)
    set(file OCTOBLISK_${library}${bullet_suffix})
    find_library(${file} ${library}${bullet_suffix})
    mark_as_advanced(${file})
    if(NOT ${file})
      return()
    endif()
    list(APPEND files ${${file}})
  endforeach()
  add_library(${target} INTERFACE IMPORTED)
  set_target_properties(${target} PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${OCTOBLISK_BULLET_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES "${files}")
  if(bullet_suffix STREQUAL "-float64")
    target_compile_definitions(${target} INTERFACE BT_USE_DOUBLE_PRECISION)
  endif()
endfunction()

octoblisk_bullet_physics(OctoBlisk::bullet_physics "")
octoblisk_bullet_physics(OctoBlisk::bullet_physics_float64 "-float64")
