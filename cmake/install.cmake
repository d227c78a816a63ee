# What `cmake --install` puts where, and the Debian package of the same by `cpack`.
# The solver's builds stand in a folder of their own, where the program and what links with them
# find them by their run path, and the loader the one for its processor.
set(library_folder ${CMAKE_INSTALL_LIBDIR}/supple)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/supple)

set_target_properties(supple_solver PROPERTIES EXPORT_NAME solver)
set_target_properties(supple_io PROPERTIES EXPORT_NAME io)
set_target_properties(supple_modeler PROPERTIES EXPORT_NAME modeler)
install(TARGETS supple DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS supple_import DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/supple)
install(TARGETS supple_solver supple_io supple_modeler EXPORT supple
  LIBRARY DESTINATION ${library_folder} ARCHIVE DESTINATION ${library_folder})
install(TARGETS supple_minimizers DESTINATION ${library_folder})
if(SUPPLE_FAST_CPU)
  install(TARGETS supple_solver_v3 supple_minimizers_v3 DESTINATION ${library_folder}/glibc-hwcaps/x86-64-v3)
endif()
foreach(folder solver io modeler)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/supple
    FILES_MATCHING PATTERN "*.h" PATTERN "modeler/cli" EXCLUDE)
endforeach()

include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/package/supple-config.cmake.in supple-config.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(supple-config-version.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT supple NAMESPACE supple:: FILE supple-targets.cmake DESTINATION ${package_folder})
install(FILES
  ${PROJECT_BINARY_DIR}/supple-config.cmake ${PROJECT_BINARY_DIR}/supple-config-version.cmake
  DESTINATION ${package_folder})

configure_file(cmake/package/supple.1.in supple.1 @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/supple.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES cmake/package/completion.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME supple)
install(FILES README.md CHANGELOG.md docs/scene.md docs/inspect.md docs/study.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME supple)
set(CPACK_PACKAGE_CONTACT "The Supple project")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libosmesa6)  # pictures; loaded where one is asked for
include(CPack)
