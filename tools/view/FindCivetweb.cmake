# Finds civetweb by its files: the configuration that Debian installs refers to modules that it does not install.
# Gives the target Civetweb::Civetweb.
find_path(CIVETWEB_INCLUDE_DIR civetweb.h)
find_library(CIVETWEB_LIBRARY civetweb)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Civetweb
  REQUIRED_VARS CIVETWEB_LIBRARY CIVETWEB_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install libcivetweb-dev")
mark_as_advanced(CIVETWEB_INCLUDE_DIR CIVETWEB_LIBRARY)

if(CIVETWEB_FOUND AND NOT TARGET Civetweb::Civetweb)
  add_library(Civetweb::Civetweb UNKNOWN IMPORTED)
  set_target_properties(Civetweb::Civetweb PROPERTIES
    IMPORTED_LOCATION ${CIVETWEB_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CIVETWEB_INCLUDE_DIR})
endif()
