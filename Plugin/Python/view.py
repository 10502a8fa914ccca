# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that follow the camera, in pvpython and ParaView's Python shell.

    from isodiamonds import view
    view.use(surface)                 # the camera's place now, for any filter of the plugin that
                                      # has the property View Dependent
    following = view.follow(surface)  # and again after every interaction, until following.stop()

The mesh is fit for all directions in which the camera can turn, and so coarse that errors stay
below PixelTolerance pixels of the view's height.
"""


def use(proxy, view=None):
    """Sets a filter's viewpoint from a render view, the active one by default.

    Raises ValueError for a camera in parallel projection: all its distances look the same, so an
    error tolerance says it all (2 * CameraParallelScale * pixels / height of the view).
    """
    view = view or _active_view()
    if view.CameraParallelProjection:
        raise ValueError("a camera in parallel projection has no viewpoint")
    proxy.ViewPosition = list(view.CameraPosition)
    proxy.ViewAngle = view.CameraViewAngle
    proxy.ViewHeight = view.ViewSize[1]
    proxy.ViewDependent = 1


class follow:
    """Calls use() now and whenever an interaction with the view ends, until stop()."""

    def __init__(self, proxy, view=None):
        self.proxy = proxy
        self.view = view or _active_view()
        interactor = self.view.GetInteractor()
        if interactor is None:
            raise ValueError("the view has no interactor: it was never rendered on a screen")
        self._interactor = interactor
        self._tag = interactor.AddObserver("EndInteractionEvent", self._update)
        self._update()

    def stop(self):
        """The mesh stays as it is."""
        if self._tag is not None:
            self._interactor.RemoveObserver(self._tag)
            self._tag = None

    def _update(self, *_):
        from paraview import simple

        use(self.proxy, self.view)
        simple.Render(self.view)


def _active_view():
    from paraview import simple

    return simple.GetActiveViewOrCreate("RenderView")
