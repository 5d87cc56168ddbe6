# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
#
# What `cmake --install` and `cpack` put where: GNUInstallDirs has the places.
include(CMakePackageConfigHelpers)

# Where Debian's Python looks below /usr and /usr/local.
set(python lib/python3/dist-packages)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/Graupel)

# What is to be installed is built before: the program brings all of it, and tests need not be.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

# The program, and the libraries for find_package(Graupel).
set(rooms base closures mesh dem fluid coupling simulation)
foreach(room IN LISTS rooms)
  set_target_properties(graupel_${room} PROPERTIES EXPORT_NAME ${room})
endforeach()
list(TRANSFORM rooms PREPEND graupel_ OUTPUT_VARIABLE libraries)
set_target_properties(graupel_options PROPERTIES EXPORT_NAME options)
install(TARGETS graupel)
install(TARGETS graupel_options ${libraries} EXPORT GraupelTargets)
install(EXPORT GraupelTargets NAMESPACE Graupel:: DESTINATION ${config})
install(DIRECTORY include/graupel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
configure_package_config_file(cmake/GraupelConfig.cmake.in GraupelConfig.cmake
                              INSTALL_DESTINATION ${config} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(GraupelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GraupelConfig.cmake
              ${PROJECT_BINARY_DIR}/GraupelConfigVersion.cmake
        DESTINATION ${config})

# The Python module, and the scripts as commands that find it from where they lie.
install(DIRECTORY python/graupel DESTINATION ${python} PATTERN __pycache__ EXCLUDE)
file(RELATIVE_PATH up_and_down "/${CMAKE_INSTALL_BINDIR}" "/${python}")
foreach(name report particles render)
  file(READ scripts/${name} text)
  string(REPLACE "parents[1] / \"python\"" "parent / \"${up_and_down}\"" moved "${text}")
  if(moved STREQUAL text)
    message(FATAL_ERROR "scripts/${name} does not name the folder of the module as expected")
  endif()
  string(REPLACE "scripts/${name}" "graupel-${name}" moved "${moved}")
  file(WRITE ${PROJECT_BINARY_DIR}/installed/graupel-${name} "${moved}")
  install(PROGRAMS ${PROJECT_BINARY_DIR}/installed/graupel-${name} TYPE BIN)
endforeach()

# Examples and pages. Cases of prm/validation are run by a script of the sources.
install(DIRECTORY prm DESTINATION ${CMAKE_INSTALL_DATADIR}/graupel PATTERN validation EXCLUDE)
install(FILES doc/graupel.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES README.md CHANGELOG.md CITATION.cff TYPE DOC)
install(FILES LICENSE TYPE DOC RENAME copyright)
install(DIRECTORY doc/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/doc
        FILES_MATCHING PATTERN *.md PATTERN *.png PATTERN generated EXCLUDE)
# If scripts/doc has made them.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/doc/html TYPE DOC OPTIONAL)

# A package runs on any machine of its kind, so `cpack` is for portable builds.
if(NOT GRAUPEL_NATIVE)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_VENDOR "The Graupel authors")
  set(CPACK_PACKAGE_CONTACT "The Graupel authors <graupel@graupel.invalid>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "gas or liquid flowing through beds of spheres (CFD-DEM)")
  set(CPACK_PACKAGE_DESCRIPTION
      "A volume-averaged Navier-Stokes solver, coupled two-way to soft-sphere
discrete elements, in parallel on MPI, driven by parameter files. A bed is
computed with scaled particles, and the flow feels the original ones.")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy, python3-matplotlib")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin")
  # To draw with graupel-render, and to compile against the libraries.
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS
      "python3-vtk9, xvfb, python3-h5py, libdeal.ii-dev, libginac-dev, nlohmann-json3-dev, zlib1g-dev, cmake, g++")
  include(CPack)
endif()
