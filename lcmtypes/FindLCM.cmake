# Finds LCM by its files: Debian's lcm.pc requires glib's development files, which linking with -llcm does not need.
# Gives the target LCM::LCM and the program LCM_GEN.
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)
find_program(LCM_GEN lcm-gen)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM
  REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR LCM_GEN
  REASON_FAILURE_MESSAGE "install liblcm-dev and liblcm-bin, or configure with -DTALUS_LCM=OFF")
mark_as_advanced(LCM_INCLUDE_DIR LCM_LIBRARY LCM_GEN)

if(LCM_FOUND AND NOT TARGET LCM::LCM)
  add_library(LCM::LCM UNKNOWN IMPORTED)
  set_target_properties(LCM::LCM PROPERTIES
    IMPORTED_LOCATION ${LCM_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
endif()
