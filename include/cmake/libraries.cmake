# The libraries that programs link: each is a target talus::NAME here and a component NAME of find_package(talus).
include(GNUInstallDirs)
# Headers that only public headers include lie apart, so that their names meet no others.
set(TALUS_INTERNAL_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/talus/internal)
configure_file(include/talus/version.h.in ${PROJECT_BINARY_DIR}/include/talus/version.h @ONLY)

# talus_library(NAME KIND SOURCES...): library talus_NAME, STATIC or SHARED, installed.
function(talus_library name kind)
  add_library(talus_${name} ${kind} ${ARGN})
  add_library(talus::${name} ALIAS talus_${name})
  target_precompile_headers(talus_${name} REUSE_FROM talus_core_headers)
  set_target_properties(talus_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY TALUS_COMPONENTS ${name})
  install(TARGETS talus_${name} EXPORT talus_${name})
endfunction()
