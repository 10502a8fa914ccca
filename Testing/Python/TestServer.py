# SPDX-License-Identifier: BSD-3-Clause
"""The plugin on a pvserver, started by the command after the first argument: the same meshes as
without a server, and pictures and data of them come back to the client."""
import os
import socket
import subprocess
import sys

from paraview.simple import *

PLUGIN = os.environ["ISODIAMONDS_PLUGIN"]
LoadPlugin(PLUGIN, remote=False, ns=globals())


def counts():
    """The number of cells of each filter's output, of all its pieces together."""
    wavelet = Wavelet(WholeExtent=[-16, 16] * 3)
    wavelet.UpdatePipeline()
    contour = IsodiamondContour(wavelet, Isosurfaces=[150], ErrorTolerance=0.2)
    volume = IsodiamondIntervalVolume(wavelet, Isorange=[150, 300], ErrorTolerance=0.5)
    hierarchy = IsodiamondHierarchy(wavelet, Isovalue=150, ErrorMetric="Distance", ComputeNormals=1)
    hierarchy.UpdatePipeline()
    extract = IsodiamondExtract(hierarchy, ErrorTolerance=0.2)
    points = IsodiamondPoints(hierarchy)
    result = []
    for filter in (contour, volume, hierarchy, extract, points):
        filter.UpdatePipeline()
        result.append(filter.GetDataInformation().GetNumberOfCells())
    view = CreateView("RenderView")
    view.ViewSize = [200, 150]
    Show(contour, view)
    Render(view)
    fetched = servermanager.Fetch(contour)
    assert fetched.GetNumberOfCells() == result[0]
    return result


alone = counts()
assert all(count > 0 for count in alone), alone
assert alone[0] == alone[3], alone
Disconnect()

with socket.socket() as free:
    free.bind(("127.0.0.1", 0))
    port = free.getsockname()[1]
# This process may run under MPI itself; the server's must not inherit the variables that say so.
environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_", "PMIX_"))}
server = subprocess.Popen(
    [*sys.argv[2:], f"--server-port={port}"], stdout=subprocess.PIPE, text=True, env=environment
)
try:
    while "Accepting connection" not in server.stdout.readline():
        assert server.poll() is None, "the server ended"
    assert Connect("127.0.0.1", port)
    LoadPlugin(PLUGIN, remote=True)
    LoadPlugin(PLUGIN, remote=False, ns=globals())
    served = counts()
    assert served == alone, (served, alone)
except BaseException:
    server.kill()
    raise
# The server ends when its client does.
