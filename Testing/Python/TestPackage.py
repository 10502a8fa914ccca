# SPDX-License-Identifier: BSD-3-Clause
"""The package as installed: ParaView lists the plugin without being told, and loads it by its name;
Python finds the VTK module. scripts/try-package.sh runs this."""
from paraview.simple import *
from isodiamonds import vtkIsodiamondContour

LoadDistributedPlugin("Isodiamonds", remote=False, ns=globals())
volume = Wavelet(WholeExtent=[-8, 8] * 3)
volume.UpdatePipeline()
surface = IsodiamondContour(Input=volume, Isosurfaces=[150])
surface.UpdatePipeline()
triangles = surface.GetDataInformation().GetNumberOfCells()
assert triangles > 0, "the plugin's filter gave no triangles"

contour = vtkIsodiamondContour()
contour.SetInputDataObject(servermanager.Fetch(volume))
contour.SetValue(0, 150)
contour.Update()
assert contour.GetOutput().GetNumberOfCells() == triangles, "the module gives another surface"
print(f"{triangles} triangles by the plugin and by the module")
