# Debian's own CMake config for Bullet exports variables with relative paths and no targets; this makes one target,
# BulletPhysics::dynamics. Single precision. Its headers count as system headers: their warnings are not ours.
find_path(BulletPhysics_INCLUDE_DIR btBulletDynamicsCommon.h PATH_SUFFIXES bullet)
foreach(part BulletDynamics BulletCollision LinearMath)
  find_library(BulletPhysics_${part} ${part})
  list(APPEND BulletPhysics_LIBRARIES ${BulletPhysics_${part}})
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BulletPhysics REQUIRED_VARS BulletPhysics_LIBRARIES BulletPhysics_INCLUDE_DIR)
if(BulletPhysics_FOUND AND NOT TARGET BulletPhysics::dynamics)
  add_library(BulletPhysics::dynamics INTERFACE IMPORTED GLOBAL)
  target_include_directories(BulletPhysics::dynamics SYSTEM INTERFACE ${BulletPhysics_INCLUDE_DIR})
  target_link_libraries(BulletPhysics::dynamics INTERFACE ${BulletPhysics_LIBRARIES})
endif()
