# SPDX-License-Identifier: BSD-3-Clause
"""The Python examples do what they say. Argument: a folder for files."""
import os
import re
import subprocess
import sys

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "Python")
FOLDER = os.path.join(sys.argv[1], "examples")
os.makedirs(FOLDER, exist_ok=True)


def run(example, *arguments):
    """The output of an example, run in the folder."""
    return subprocess.run(
        [os.environ["ISODIAMONDS_PYTHON"], os.path.join(EXAMPLES, example), *arguments],
        cwd=FOLDER, check=True, stdout=subprocess.PIPE, text=True,
    ).stdout


def made(name):
    path = os.path.join(FOLDER, name)
    assert os.path.getsize(path) > 1000, name
    return path


counts = [int(n) for n in re.findall(r"(\d+) triangles", run("levels_of_detail.py", "levels.vtp"))]
assert len(counts) == 5 and counts[0] > counts[1] > counts[2] > counts[3] > 0, counts
assert counts[3] < counts[4] < counts[0], counts
made("levels.vtp")

run("adaptive_contour.py", os.environ["ISODIAMONDS_PLUGIN"])
made("adaptive.png")

from isodiamonds import vtkIsodiamondIntervalVolume
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

source = vtkRTAnalyticSource()
volume = vtkIsodiamondIntervalVolume()
volume.SetInputConnection(source.GetOutputPort())
volume.SetIsorange(150, 300)
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputConnection(volume.GetOutputPort())
writer.SetDataModeToBinary()
writer.SetFileName(os.path.join(FOLDER, "volume.vtu"))
writer.Write()
angles = run("dihedral_angles.py", made("volume.vtu"))
assert re.search(r"\d", angles), angles

# With /usr/bin/python3, if that has the libraries: ParaView's interpreter need not.
heat = os.path.join(EXAMPLES, "heat.py")
libraries = ["/usr/bin/python3", "-c", "import getfem, meshio, scipy"]
if subprocess.run(libraries, check=False, stderr=subprocess.DEVNULL).returncode == 0:
    told = subprocess.run(
        ["/usr/bin/python3", heat, made("volume.vtu"), os.path.join(FOLDER, "heat.vtu")],
        check=True, stdout=subprocess.PIPE, text=True,
    ).stdout
    assert int(re.search(r"(\d+) steps", told).group(1)) > 10, told
    made("heat.vtu")
