# The VTK module IsodiamondFilters, on ParaView's VTK or on a plain one.
if(ISODIAMONDS_BUILD_PARAVIEW_PLUGIN)
  find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingCore RemotingServerManager)
else()
  find_package(VTK 9.1 REQUIRED
    COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMisc FiltersCore)
endif()
if(BUILD_TESTING)
  # What the tests use besides: here, because imported targets belong to the folder that finds them.
  find_package(VTK REQUIRED
    COMPONENTS CommonExecutionModel FiltersCore FiltersExtraction FiltersGeneral ImagingCore IOXML
      InteractionStyle RenderingCore RenderingFreeType RenderingOpenGL2 TestingRendering
    PATHS "${VTK_DIR}" NO_DEFAULT_PATH) # the VTK that ParaView brought
endif()

vtk_module_scan(
  MODULE_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module"
  REQUEST_MODULES IsodiamondFilters
  PROVIDES_MODULES isodiamond_modules
  REQUIRES_MODULES isodiamond_required
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON
  ENABLE_TESTS OFF)
list(APPEND CMAKE_INSTALL_RPATH "$ORIGIN")
vtk_module_build(
  MODULES ${isodiamond_modules}
  PACKAGE Isodiamonds
  INSTALL_EXPORT Isodiamonds
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/Isodiamonds"
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/isodiamonds"
  TEST_DIRECTORY_NAME "NONE")
