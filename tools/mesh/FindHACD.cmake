# HACD (hierarchical approximate convex decomposition) as Debian's libbullet-extras-dev ships it: one target, HACD::HACD.
# Its headers count as system headers: their warnings are not ours.
find_path(HACD_INCLUDE_DIR hacdHACD.h PATH_SUFFIXES bullet/HACD)
find_library(HACD_LIBRARY HACD)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HACD REQUIRED_VARS HACD_LIBRARY HACD_INCLUDE_DIR)
if(HACD_FOUND AND NOT TARGET HACD::HACD)
  add_library(HACD::HACD INTERFACE IMPORTED GLOBAL)
  target_include_directories(HACD::HACD SYSTEM INTERFACE ${HACD_INCLUDE_DIR})
  target_link_libraries(HACD::HACD INTERFACE ${HACD_LIBRARY})
endif()
