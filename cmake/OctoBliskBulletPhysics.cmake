# Makes targets of Bullet's libraries, one for each precision that is found: OctoBlisk::bullet_physics (single) and
# OctoBlisk::bullet_physics_float64. The build includes this file, and so does the installed find_package(OctoBlisk).
#
# A project that defines these targets itself keeps them. Otherwise they are made from, in this order:
#   1. Bullet's own targets (BulletCollision, …), made by FetchContent, add_subdirectory or find_package(Bullet);
#   2. the libraries of find_package(Bullet CONFIG), in the precision that Bullet's package reports;
#   3. libraries with Debian's names, which end in -float64 for double precision.
find_path(OCTOBLISK_BULLET_INCLUDE_DIR BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h
  PATH_SUFFIXES bullet)
mark_as_advanced(OCTOBLISK_BULLET_INCLUDE_DIR)

function(octoblisk_bullet_physics target precision)
  if(TARGET ${target})
    return()
  endif()
  if(NOT TARGET BulletCollision)
    find_package(Bullet CONFIG QUIET)
  endif()
  # Bullet gives its targets and libraries the same names in both precisions.
  set(precision_of_bullet single)
  if(USE_DOUBLE_PRECISION OR BULLET_DEFINITIONS MATCHES BT_USE_DOUBLE_PRECISION)
    set(precision_of_bullet float64)
  endif()

  set(libraries BulletSoftBody BulletDynamics BulletCollision LinearMath)
  set(include_dirs ${OCTOBLISK_BULLET_INCLUDE_DIR})
  if(TARGET BulletCollision AND precision STREQUAL precision_of_bullet)
    get_target_property(include_dirs BulletCollision INTERFACE_INCLUDE_DIRECTORIES)
    if(NOT include_dirs)  # Bullet's own CMake files do not set it
      get_target_property(source_dir BulletCollision SOURCE_DIR)
      get_filename_component(include_dirs ${source_dir} DIRECTORY)
    endif()
  else()
    set(names ${libraries})
    set(libraries)
    foreach(name ${names})
      set(file OCTOBLISK_${name}_${precision})
      set(suffixed ${name}-${precision})
      if(precision STREQUAL precision_of_bullet)
        find_library(${file} NAMES ${name} ${suffixed} HINTS ${BULLET_ROOT_DIR} PATH_SUFFIXES lib)
      else()
        find_library(${file} ${suffixed})
      endif()
      mark_as_advanced(${file})
      if(NOT ${file})
        return()
      endif()
      list(APPEND libraries ${${file}})
    endforeach()
  endif()
  if(NOT include_dirs)
    return()
  endif()
  add_library(${target} INTERFACE IMPORTED)
  set_target_properties(${target} PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${include_dirs}"
    INTERFACE_LINK_LIBRARIES "${libraries}")
  if(precision STREQUAL float64)
    target_compile_definitions(${target} INTERFACE BT_USE_DOUBLE_PRECISION)
  endif()
  if(BULLET2_MULTITHREADING)  # Bullet's own option; its headers differ with it
    target_compile_definitions(${target} INTERFACE BT_THREADSAFE=1)
  endif()
  find_file(header LinearMath/btScalar.h PATHS ${include_dirs} NO_DEFAULT_PATH NO_CACHE)
  if(header AND NOT OctoBlisk_FIND_QUIETLY)
    file(STRINGS ${header} version REGEX "define BT_BULLET_VERSION")
    string(REGEX REPLACE ".* ([0-9]+)([0-9][0-9])" "\\1.\\2" version "${version}")
    message(STATUS "OctoBlisk: Bullet ${version}, ${precision} precision, in ${include_dirs}")
  endif()
endfunction()

octoblisk_bullet_physics(OctoBlisk::bullet_physics single)
octoblisk_bullet_physics(OctoBlisk::bullet_physics_float64 float64)
