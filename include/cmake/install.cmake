# What `cmake --install` copies: the command with its data, and the libraries with what finds them. Nothing in it depends
# on where it lies.
include(CMakePackageConfigHelpers)
get_property(components GLOBAL PROPERTY TALUS_COMPONENTS)

# Headers: those in include/talus/ of the libraries that were built, and those that they include.
install(DIRECTORY include/talus DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h
        PATTERN box2d_world.h EXCLUDE PATTERN bullet_world.h EXCLUDE PATTERN telemetry.h EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/include/talus/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus)
install(DIRECTORY common DESTINATION ${TALUS_INTERNAL_HEADERS} FILES_MATCHING PATTERN *.h)
if(TALUS_BOX2D)
  install(FILES include/talus/box2d_world.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus)
  install(FILES sim2d/make_world.h DESTINATION ${TALUS_INTERNAL_HEADERS}/sim2d)
endif()
if(TALUS_BULLET)
  install(FILES include/talus/bullet_world.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus)
  install(FILES sim3d/make_world.h DESTINATION ${TALUS_INTERNAL_HEADERS}/sim3d)
endif()
if(TALUS_LCM)
  install(FILES include/talus/telemetry.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus)
  install(DIRECTORY lcmtypes DESTINATION ${TALUS_INTERNAL_HEADERS} FILES_MATCHING PATTERN *.h)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/lcmtypes/generated/talus_lcm DESTINATION ${TALUS_INTERNAL_HEADERS})
  install(DIRECTORY lcmtypes DESTINATION ${CMAKE_INSTALL_DATADIR}/talus FILES_MATCHING PATTERN *.lcm)
endif()

# find_package(talus), in an installed tree and in the build's.
set(package ${PROJECT_BINARY_DIR}/cmake)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
configure_file(include/cmake/talusConfig.cmake.in ${package}/talusConfig.cmake @ONLY)
write_basic_package_version_file(${package}/talusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${package}/talusConfig.cmake ${package}/talusConfigVersion.cmake DESTINATION ${config_folder})
foreach(name IN LISTS components)
  install(EXPORT talus_${name} DESTINATION ${config_folder} NAMESPACE talus::)
  export(EXPORT talus_${name} FILE ${package}/talus_${name}.cmake NAMESPACE talus::)
endforeach()
foreach(module sim3d/FindBulletPhysics lcmtypes/FindLCM)
  file(COPY ${module}.cmake DESTINATION ${package}/modules)
  install(FILES ${module}.cmake DESTINATION ${config_folder}/modules)
endforeach()

# talus_pkg_config(NAME DESCRIPTION REQUIRES CFLAGS LIBS): NAME.pc
set(pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH to_prefix /${pc_folder} /)
function(talus_pkg_config name description requires cflags libs)
  configure_file(include/cmake/talus.pc.in ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc DESTINATION ${pc_folder})
endfunction()
string(REPLACE ${CMAKE_INSTALL_INCLUDEDIR} "\${includedir}" internal ${TALUS_INTERNAL_HEADERS})
talus_pkg_config(talus-core "Piles of rigid bodies: policies of sleep" "eigen3 fmt qhull_r"
                 "-I\${includedir} -I${internal}" "-L\${libdir} -ltalus_core")
talus_pkg_config(talus-scene "Piles of rigid bodies: scene files" "talus-core tomlplusplus tinyobjloader_double" ""
                 "-L\${libdir} -ltalus_scene -lpolyclipping")
if(TALUS_BOX2D)
  talus_pkg_config(talus-box2d "Piles of rigid bodies on Box2D" "talus-core box2d" "" "-L\${libdir} -ltalus_box2d")
endif()
if(TALUS_BULLET)
  talus_pkg_config(talus-bullet "Piles of rigid bodies on Bullet" "talus-core bullet" "" "-L\${libdir} -ltalus_bullet")
endif()
if(TALUS_LCM)
  # Not lcm.pc, which requires the development files of glib.
  talus_pkg_config(talus-telemetry "Piles of rigid bodies: record and live messages" "talus-core spdlog zlib" ""
                   "-L\${libdir} -ltalus_telemetry -llcm -pthread")
endif()
talus_pkg_config(talus "Piles of rigid bodies: sleep for any engine, in C" "" "-I\${includedir}" "-L\${libdir} -ltalus")

# The command.
install(TARGETS talus)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/talus)
install(DIRECTORY tools/view/page/dist/ DESTINATION ${CMAKE_INSTALL_DATADIR}/talus/page)
# Manual page and completions are the command's own words.
set(texts ${CMAKE_BINARY_DIR}/texts)
add_custom_command(
  OUTPUT ${texts}/talus.1 ${texts}/talus ${texts}/_talus
  COMMAND ${CMAKE_COMMAND} -E make_directory ${texts}
  COMMAND talus reference --man > ${texts}/talus.1
  COMMAND talus reference --completion bash > ${texts}/talus
  COMMAND talus reference --completion zsh > ${texts}/_talus
  VERBATIM)
add_custom_target(talus_texts ALL DEPENDS ${texts}/talus.1)
install(FILES ${texts}/talus.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${texts}/talus DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${texts}/_talus DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
