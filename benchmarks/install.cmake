# cmake --install: the program, its data, man page and completion; CPack makes a Debian package of
# them: benchmarks/package.
include(GNUInstallDirs)
install(TARGETS diptych)
if(TARGET diptych_mpi) # cmake --install BUILD --component ranks: the package does not ask for an MPI library
  install(TARGETS diptych_mpi LIBRARY DESTINATION lib/diptych COMPONENT ranks EXCLUDE_FROM_ALL)
endif()
foreach(folder ${data})
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/diptych)
endforeach()
install(FILES setup/diptych.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME diptych)
find_program(GZIP_PROGRAM gzip REQUIRED)
set(man_page ${CMAKE_CURRENT_BINARY_DIR}/diptych.1.gz)
add_custom_command(OUTPUT ${man_page} DEPENDS setup/diptych.1
  COMMAND ${GZIP_PROGRAM} -9nc ${CMAKE_CURRENT_SOURCE_DIR}/setup/diptych.1 > ${man_page})
add_custom_target(man_page ALL DEPENDS ${man_page})
add_dependencies(diptych man_page)
install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md USING.md VERIFICATION.md LITERATURE.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
# HDF5 and GCC's OpenMP runtime are inside the program: their notices go with it.
string(REGEX MATCH "^[0-9]+" gcc_major "${CMAKE_CXX_COMPILER_VERSION}")
install(FILES /usr/share/doc/libhdf5-dev/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright.hdf5 OPTIONAL)
install(FILES /usr/share/doc/gcc-${gcc_major}-base/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright.gcc OPTIONAL)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON PARENT_SCOPE) # the tests need not be built for it
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME diptych)
set(CPACK_PACKAGE_VENDOR "The Diptych developers")
set(CPACK_PACKAGE_CONTACT "The Diptych developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "one large-strain solid-dynamics scene on SPH and finite volumes")
set(CPACK_PACKAGE_DESCRIPTION "Runs a scene of large-strain viscoelastic solid dynamics with Total Lagrangian SPH
 and vertex-centred finite volumes on the same nodes, and says what each costs for the error it makes.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libjs-chart.js) # what reports draw their plots with
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gmsh)        # meshes of .geo files
include(CPack)
