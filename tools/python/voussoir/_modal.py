"""Modes of vibration."""

import os

from . import _voussoir
from ._assembly import _first


class Modes:
    """Modes, the lowest first.

    frequency       Hz, shape (m,); 0 for a rigid motion or a mechanism
    period          s, shape (m,); infinite where the frequency is 0
    shapes          of each block displacement of the centroid and rotation vector, world axes, shape (m, n, 6); the
                    largest displacement is 1, rotations are per m of it
    fill_shapes     of each node of the fill, shape (m, k, 3)
    effective_mass  kg, along x, y, z, shape (m, 3)
    participation   shape (m, 3)
    modal_mass      kg, of that shape, shape (m,)
    damping_ratio   of the case's damping, shape (m,)
    words           'transverse, 1st order', ...
    mass            kg, of all that can move
    about           what was analysed
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
    modes      how many; None: the case's, 10
    state      of a case: 'intact' (all joints elastic) or 'gravity' (as they rest); None: as the case says
    geometric  with the stiffness of the forces that the joints carry
    as_stored  of a run: the state as it is; else it is brought to rest with its damage
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
