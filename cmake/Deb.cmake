# A Debian package of all that is installed; scripts/package.sh makes it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME isodiamonds)
set(CPACK_PACKAGE_VENDOR "The Isodiamonds developers")
set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "Adaptive isosurfaces and interval volumes of large volumes, for ParaView and VTK")
string(CONCAT CPACK_PACKAGE_DESCRIPTION
  "Builds a compact multiresolution hierarchy of an isosurface or an interval volume, and extracts\n"
  "triangle or tetrahedral meshes without cracks from it at any error tolerance. A plugin for\n"
  "ParaView, a Python package, and headers and CMake files for C++.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

# The dependency on ParaView in the version of this build comes from its libraries; that on Python
# is set by hand, since only the interpreter loads its modules. Programs in C++ also need ParaView's
# development files.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
if(ISODIAMONDS_WRAP_PYTHON)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "python3-paraview, python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor})")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS paraview-dev)

# Goes where ParaView looks for other packages' plugins, so that its plugin manager lists this one.
# Debian's ParaView has a folder for them from 13 on. That of Debian 12 knows only its own plugins,
# unless there is a configuration beside the program, which no package has: ours names ParaView's
# list and our own.
set(library_folder "${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}")
set(plugin_folder "${library_folder}/${PARAVIEW_PLUGIN_SUBDIR}")
set(files "${CMAKE_CURRENT_BINARY_DIR}/deb")
if(EXISTS "${plugin_folder}/../paraview.conf")
  file(MAKE_DIRECTORY "${files}")
  file(CREATE_LINK "${plugin_folder}/Isodiamonds/Isodiamonds.so" "${files}/Isodiamonds.so" SYMBOLIC)
  install(FILES "${files}/Isodiamonds.so" DESTINATION share/paraview/plugins/Isodiamonds)
else()
  file(WRITE "${files}/isodiamonds.plugins.xml"
    "<?xml version=\"1.0\"?>\n<Plugins>\n  <Plugin name=\"Isodiamonds\" auto_load=\"0\"/>\n</Plugins>\n")
  file(WRITE "${files}/paraview.conf"
    "${plugin_folder}/paraview.plugins.xml\n${plugin_folder}/isodiamonds.plugins.xml\n")
  install(FILES "${files}/isodiamonds.plugins.xml"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}")
  install(FILES "${files}/paraview.conf" DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
install(FILES LICENSE RENAME copyright DESTINATION share/doc/isodiamonds)

include(CPack)
