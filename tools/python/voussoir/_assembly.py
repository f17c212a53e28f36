"""Assemblies from arrays and from files of other programs."""

import os
import warnings

from . import _voussoir
from ._errors import InputError
from ._toml import dumps


def _first(value, otherwise):
    return otherwise if value is None else value


def _cells(block):
    """[(vertices, faces), ...] of a block given as one pair or as several."""
    if isinstance(block, tuple) and len(block) == 2:
        return [block]
    return list(block)


def _said(result):
    assembly, notes = result
    for note in notes:
        warnings.warn(note, stacklevel=3)
    return assembly


def assembly_from_blocks(blocks, *, fixed=None, components=None, parts=None, materials=None, block_materials=None,
                         groups=None, kn=None, ks=None, gap=1e-4):
    """Makes an Assembly of closed shapes. The program finds the joints where faces meet.

    blocks           one entry a block: (vertices, faces) with vertices of shape (v, 3) in m, z upwards, and faces as
                     loops of vertex numbers; or, of a block that is not convex, a list of such pairs, its convex cells.
    fixed            truth values or block numbers: which blocks move with the ground; None: those that reach down to
                     the lowest point.
    components       component of each block, such as 'arch' or 'pier' (component_names() lists them); None: 'block'.
    parts            number of each block's part among those of its component; None: 0.
    materials        dictionaries with name, density (kg/m3), youngs_modulus, shear_modulus, tensile_strength,
                     cohesion (Pa), friction_angle (degrees); a joint has the weaker strength of its two
                     materials. None: dry stone of 2000 kg/m3, E = 4 GPa, G = 1.6 GPa, 30 degrees.
    block_materials  name of each block's material; None: the first of `materials`.
    groups           {name: [block, ...]}: what loads, drives and outputs of a case can name.
    kn, ks           Pa/m of every joint; None: from the moduli and the sizes of the stones.
    gap              m: faces closer than this are in contact.

    Raises InputError for a shape that is not closed, not convex or without volume, and for blocks that overlap. Warns
    of each repair of a shape, and of results that you may not expect.
    """
    blocks = [_cells(block) for block in blocks]
    count = len(blocks)
    flags = []
    if fixed is not None:
        fixed = list(fixed)
        if fixed and all(isinstance(f, bool) or type(f).__name__ == "bool_" for f in fixed):
            flags = [bool(f) for f in fixed]
        else:
            numbers = {int(f) for f in fixed}
            unknown = sorted(f for f in numbers if not 0 <= f < count)
            if unknown:
                raise InputError(f"'fixed' names block {unknown[0]}, and there are blocks 0 to {count - 1}.")
            flags = [i in numbers for i in range(count)]
    return _said(_voussoir._from_arrays(
        blocks, list(components or []), [int(p) for p in _first(parts, [])], list(block_materials or []), flags,
        [dumps(m) for m in (materials or [])], _first(kn, 0.0), _first(ks, 0.0), gap,
        {name: [int(b) for b in members] for name, members in (groups or {}).items()}))


def import_blocks(path, *, scale=1.0, up="", fixed="", map=None, material=None, kn=None, ks=None, gap=1e-4):
    """An Assembly of a file of another program, as `voussoir import` makes it.

    path      OBJ, PLY, STL, glTF, COMPAS (JSON) or an assembly (HDF5).
    scale     m per unit of the file.
    up        the file's axis that points up: x, y, z, -x, -y, -z; '': as the format has it.
    fixed     'lowest', 'none', or names or numbers of stones with commas between them; '': as the file or the map
              say, else the lowest.
    map       TOML file that says what objects are by their names (docs/formats.md).
    material  dictionary as in assembly_from_blocks().
    kn, ks    Pa/m of every joint; None: from the moduli.
    gap       m: faces closer than this are in contact.
    """
    return _said(_voussoir._from_file(os.fspath(path), scale, up, fixed, os.fspath(map) if map else "", _first(kn, 0.0),
                                      _first(ks, 0.0), gap, dumps(material) if material else ""))
