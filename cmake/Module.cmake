# The VTK module IsodiamondFilters, on ParaView's VTK or on a plain one.
include(cmake/PythonTargets.cmake)
if(ISODIAMONDS_BUILD_PARAVIEW_PLUGIN)
  isodiamonds_mend_python_targets(ParaView 5.11)
  isodiamonds_find(ParaView
    "its development files, 5.11 or later (Debian: paraview-dev python3-paraview), or -DParaView_DIR=FOLDER of a ParaView's paraview-config.cmake"
    5.11 COMPONENTS RemotingCore RemotingServerManager)
else()
  isodiamonds_find(VTK "its development files, 9.1 or later (Debian: libvtk9-dev)"
    9.1 COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMisc FiltersCore ParallelCore vtksys)
endif()
if(BUILD_TESTING)
  # What the tests need besides. Here, as imported targets belong to the folder that finds them.
  isodiamonds_find(VTK
    "what its rendering tests need (Debian: libglew-dev libfreetype-dev), or BUILD_TESTING=OFF"
    COMPONENTS CommonExecutionModel FiltersCore FiltersExtraction FiltersGeneral ImagingCore IOImage IOXML
      InteractionStyle RenderingCore RenderingFreeType RenderingOpenGL2
    PATHS "${VTK_DIR}" NO_DEFAULT_PATH) # the VTK that ParaView brought
endif()

# xxHash, for hashes of the volumes in the cache, comes without a configuration for CMake.
find_path(XXHASH_INCLUDE_DIR xxhash.h)
find_library(XXHASH_LIBRARY xxhash)
mark_as_advanced(XXHASH_INCLUDE_DIR XXHASH_LIBRARY)
if(NOT XXHASH_INCLUDE_DIR OR NOT XXHASH_LIBRARY)
  message(FATAL_ERROR "xxHash is missing. Isodiamonds needs its development files, 0.8 or later (Debian: libxxhash-dev).")
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
