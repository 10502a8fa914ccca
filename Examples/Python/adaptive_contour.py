# SPDX-License-Identifier: BSD-3-Clause
"""An adaptive isosurface in ParaView's Python: pvpython adaptive_contour.py PATH/Isodiamonds.so"""
import sys

from paraview.simple import *

if len(sys.argv) < 2:
    sys.exit(__doc__)
LoadPlugin(sys.argv[1], remote=False, ns=globals())

volume = Wavelet(WholeExtent=[-32, 32] * 3)
surface = IsodiamondContour(Input=volume, Isosurfaces=[157], ErrorTolerance=0.5)
display = Show(surface)
display.Representation = "Surface With Edges"
ResetCamera()
SaveScreenshot("adaptive.png")
