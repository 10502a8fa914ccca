# The Python package isodiamonds: the wrapped VTK module.
if(NOT VTK_WRAP_PYTHON)
  message(FATAL_ERROR "This VTK has no Python wrapping; set ISODIAMONDS_WRAP_PYTHON to OFF.")
endif()
isodiamonds_find(Python3 "its headers (Debian: python3-dev), or ISODIAMONDS_WRAP_PYTHON=OFF"
  COMPONENTS Interpreter Development)
set(python_destination "lib/python3/dist-packages") # Debian's, also where libraries are in lib/ARCHITECTURE
# The target's name must not end in ::Python: that would install a header named Python.h.
vtk_module_wrap_python(
  MODULES ${isodiamond_modules}
  TARGET IsodiamondsPython
  PYTHON_PACKAGE isodiamonds
  MODULE_DESTINATION "${python_destination}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INSTALL_HEADERS OFF
  BUILD_STATIC OFF)
set(python_package "${CMAKE_BINARY_DIR}/${python_destination}/isodiamonds")
file(WRITE "${python_package}/__init__.py" "from .vtkIsodiamondFilters import *\n")
set(python_files "${python_package}/__init__.py")
if(ISODIAMONDS_BUILD_PARAVIEW_PLUGIN)
  configure_file(Plugin/Python/view.py "${python_package}/view.py" COPYONLY)
  list(APPEND python_files "${python_package}/view.py")
endif()
install(FILES ${python_files} DESTINATION "${python_destination}/isodiamonds" COMPONENT python)

# What runs it, for tests: ParaView's interpreter, or that of a plain VTK.
if(ISODIAMONDS_BUILD_PARAVIEW_PLUGIN)
  set(python "$<TARGET_FILE:ParaView::pvpython>")
else()
  set(python "${Python3_EXECUTABLE}")
endif()
