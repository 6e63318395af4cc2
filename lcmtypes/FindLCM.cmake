# Finds LCM by its files: Debian's lcm.pc requires glib's development files, which linking with -llcm does not need.
# Gives the target LCM::LCM.
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM
  REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install liblcm-dev, or build talus with -DTALUS_LCM=OFF")
mark_as_advanced(LCM_INCLUDE_DIR LCM_LIBRARY)

if(LCM_FOUND AND NOT TARGET LCM::LCM)
  add_library(LCM::LCM UNKNOWN IMPORTED)
  set_target_properties(LCM::LCM PROPERTIES
    IMPORTED_LOCATION ${LCM_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
endif()
