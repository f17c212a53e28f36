"""Drawings of blocks with matplotlib."""

# Where to look: the axes of the picture to the right and upwards, and the one away from the eye.
_views = {"front": ((1, 0, 0), (0, 0, 1), (0, 1, 0)), "side": ((0, 1, 0), (0, 0, 1), (-1, 0, 0)),
          "top": ((1, 0, 0), (0, 1, 0), (0, 0, -1))}


def _normal(loop):
    import numpy as np
    after = np.roll(loop, -1, axis=0)
    return np.cross(loop, after).sum(axis=0)


def draw(assembly, snapshot=None, *, axes=None, view="front", amplification=1.0, colour=None, label="", hide=()):
    """Draws the blocks of an assembly; returns the matplotlib axes.

    snapshot       Snapshot: where the blocks are; None: as built
    axes           to draw on; None: new ones
    view           'front' (from -y), 'side' (from +x) or 'top'
    amplification  of the displacements
    colour         number of each block, shape (n,), shown by a scale with `label`; None: grey
    hide           components that are left out
    """
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.collections import PolyCollection
    if view not in _views:
        raise ValueError(f"view is {view!r}: give 'front', 'side' or 'top'.")
    right, up, away = (np.array(axis, dtype=float) for axis in _views[view])
    faces = []
    for block, component in enumerate(assembly.components):
        if component in hide:
            continue
        cells = assembly.block(block)
        places = [corners for corners, _ in cells] if snapshot is None else snapshot.vertices(assembly, block, amplification)
        for corners, (_, loops) in zip(places, cells):
            for loop in loops:
                face = corners[loop]
                if _normal(face) @ away < 0.0:
                    faces.append((-(face @ away).mean(), np.c_[face @ right, face @ up], block))
    faces.sort(key=lambda face: face[0])
    if axes is None:
        _, axes = plt.subplots(figsize=(8, 4))
    shapes = PolyCollection([face[1] for face in faces], edgecolors="#333333", linewidths=0.4, facecolors="#c9c3b8")
    if colour is not None:
        shapes.set_facecolor(None)
        shapes.set_array(np.asarray(colour)[[face[2] for face in faces]])
        shapes.set_cmap("viridis")
        plt.colorbar(shapes, ax=axes, label=label, shrink=0.8)
    axes.add_collection(shapes)
    axes.autoscale_view()
    axes.set_aspect("equal")
    names = {"front": ("x, m", "z, m"), "side": ("y, m", "z, m"), "top": ("x, m", "y, m")}[view]
    axes.set_xlabel(names[0]), axes.set_ylabel(names[1])
    return axes
