"""Modes of vibration."""

import os

from . import _voussoir
from ._assembly import _first


class Modes:
    """Modes, the lowest first: m modes of n blocks and k nodes of a fill.

    frequency       Hz, shape (m,); 0 for a rigid motion, for a mechanism and for an unstable mode
    period          s, shape (m,); infinite where the frequency is 0
    shapes          displacement of the centroid and rotation vector of each block, world axes, shape (m, n, 6); the
                    largest displacement is 1, and rotations are in rad for 1 m of it
    fill_shapes     displacement of each node of the fill, to the same scale, shape (m, k, 3)
    effective_mass  kg, along x, y, z, shape (m, 3)
    participation   participation factors of these shapes along x, y, z, shape (m, 3)
    modal_mass      kg, of these shapes, shape (m,)
    damping_ratio   damping ratio of the mode with the damping of the case, shape (m,)
    words           'transverse, 1st order', ...
    mass            kg, of all blocks that can move, and of the fill
    about           description of the analysed state
    """

    def __init__(self, values):
        import numpy as np
        for name in ("about", "mass", "frequency", "effective_mass", "participation", "modal_mass", "damping_ratio",
                     "words", "shapes", "fill_shapes"):
            setattr(self, name, values[name])
        with np.errstate(divide="ignore"):
            self.period = 1.0 / self.frequency

    def __len__(self):
        return len(self.frequency)

    def __repr__(self):
        lines = [self.about]
        for i, word in enumerate(self.words):
            shares = 100.0 * self.effective_mass[i] / self.mass
            lines.append(f"{i + 1:3}  {self.frequency[i]:8.4f} Hz  {self.period[i]:8.4f} s  "
                         f"{shares[0]:3.0f} {shares[1]:3.0f} {shares[2]:3.0f} %  {word}")
        return "\n".join(lines)


def modal(source, modes=None, *, state=None, geometric=False, as_stored=False, threads=None):
    """Modes of a case, or of the state of a run with its damage, as `voussoir modal` finds them.

    source     Case (or what Case() takes, a dictionary or a case file), Run, or the path of a run directory or a
               checkpoint
    modes      number of modes; None: as the case says (10 by default)
    state      of a case: 'intact' (all joints elastic) or 'gravity' (as they rest); None: as the case says
    geometric  True: add the geometric stiffness of the forces in the joints
    as_stored  of a run: True: the state as it is stored; False: the program first brings it to rest with its damage
    threads    None: all that the machine has
    """
    from ._case import Case
    from ._run import Run
    threads = _first(threads, _voussoir.available_threads())
    count = _first(modes, 0)
    if state not in (None, "intact", "gravity"):
        raise ValueError(f"state is {state!r}: give 'intact' or 'gravity'.")
    if isinstance(source, Run):
        source = source.directory
    if isinstance(source, (str, os.PathLike)) and not os.fspath(source).endswith(".toml"):
        if state is not None:
            raise ValueError("state is for a case, and a run has its own.")
        return Modes(_voussoir._modal_of_state(os.fspath(source), count, geometric, as_stored, threads))
    case = source if isinstance(source, Case) else Case(source, geometry=True)
    return Modes(_voussoir._modal_of_case(case._case, count, state or "", geometric, threads))
