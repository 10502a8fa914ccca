# The ParaView plugin Isodiamonds.
#
# paraview_plugin_build adds the folder of the plugin file as a subdirectory, which cannot be the
# top folder; so Plugin/paraview.plugin is a link to the file at the top.

# Help pages, for the "?" button of the property panel, need Qt 5 and its tools.
find_program(ISODIAMONDS_QHELPGENERATOR qhelpgenerator)
find_program(ISODIAMONDS_XMLPATTERNS xmlpatterns PATHS /usr/lib/qt5/bin NO_DEFAULT_PATH)
set(no_xml_documentation ON)
if(PARAVIEW_QT_MAJOR_VERSION EQUAL 6) # ParaView 5.11 does not set it, and has Qt 5
  message(NOTICE "The plugin comes without help pages: ParaView makes them with Qt 5 only.")
elseif(NOT ISODIAMONDS_QHELPGENERATOR OR NOT ISODIAMONDS_XMLPATTERNS)
  message(NOTICE "The plugin comes without help pages: qhelpgenerator or xmlpatterns is missing "
    "(Debian 12: qttools5-dev qttools5-dev-tools qtxmlpatterns5-dev-tools).")
else()
  set(no_xml_documentation OFF)
endif()

# The plugin's own VTK module: the domains of its properties.
vtk_module_scan(
  MODULE_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/ServerManager/vtk.module"
  REQUEST_MODULES IsodiamondServerManager
  PROVIDES_MODULES isodiamond_plugin_modules
  REQUIRES_MODULES isodiamond_plugin_required
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${isodiamond_plugin_modules}
  PACKAGE IsodiamondsPlugin
  INSTALL_EXPORT IsodiamondsPlugin
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/IsodiamondsPlugin"
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/isodiamonds"
  INSTALL_HEADERS OFF
  TEST_DIRECTORY_NAME "NONE")
paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin"
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON)
paraview_plugin_build(
  PLUGINS ${plugins}
  AUTOLOAD ${plugins}
  PLUGINS_FILE_NAME isodiamonds.xml
  DISABLE_XML_DOCUMENTATION ${no_xml_documentation}
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}")
