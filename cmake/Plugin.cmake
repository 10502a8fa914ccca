# The ParaView plugin Isodiamonds.
#
# paraview_plugin_build adds the folder of the plugin file as a subdirectory, which cannot be the
# top one; Plugin/paraview.plugin is a link to the file on top.
find_program(ISODIAMONDS_QHELPGENERATOR qhelpgenerator)
find_program(ISODIAMONDS_XMLPATTERNS xmlpatterns PATHS /usr/lib/qt5/bin NO_DEFAULT_PATH)
set(no_xml_documentation ON)
if(ISODIAMONDS_QHELPGENERATOR AND ISODIAMONDS_XMLPATTERNS)
  set(no_xml_documentation OFF) # the "?" button of the property panel
endif()
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
