"""COMPAS: block models in, results out.

    assembly = voussoir.compas.assembly_of(model)      # a COMPAS model, its JSON text, or a file of it
    run = voussoir.Simulation({"stage": [{"kind": "gravity"}]}, assembly=assembly)
    run.run()
    results = voussoir.compas.results(assembly, run.snapshot())

COMPAS itself is not needed, because the exchange uses plain data.
"""

import json
import os
import tempfile

from ._assembly import import_blocks
from ._snapshot import rotation_matrix


def assembly_of(model, **options):
    """The Assembly of a COMPAS block model.

    model    path of a JSON file, its text, or an object of COMPAS (anything with to_jsonstring() or __data__)
    options  as import_blocks(): scale, fixed, material, kn, ks, gap; supports of the model stay fixed

    Raises InputError for a shape that is not closed or not convex.
    """
    if isinstance(model, (str, os.PathLike)) and not str(model).lstrip().startswith(("{", "[")):
        return import_blocks(model, **options)
    if isinstance(model, str):
        text = model
    elif hasattr(model, "to_jsonstring"):
        text = model.to_jsonstring()
    else:
        text = json.dumps({"dtype": _dtype(model), "data": model.__data__})
    with tempfile.TemporaryDirectory(prefix="voussoir-") as folder:
        path = os.path.join(folder, "model.json")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return import_blocks(path, **options)


def _dtype(model):
    kind = type(model)
    return getattr(model, "dtype", f"{'.'.join(kind.__module__.split('.')[:2])}/{kind.__name__}")


def _frame(snapshot, assembly, block):
    """4 x 4 matrix that takes the block from where it was built to where it is."""
    import numpy as np
    centre = assembly.centroids[block]
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_matrix(snapshot.rotation[block])
    matrix[:3, 3] = centre + snapshot.displacement[block] - matrix[:3, :3] @ centre
    return matrix


def results(assembly, snapshot):
    """Results as plain data, ready for json.dump and for COMPAS.

    {"blocks":     [{"index", "transformation": 4 x 4 rows, "displacement": m}, ...],
     "interfaces": [{"a", "b", "polygon": corners as built in m, "normal", "area": m2, "compression": N,
                     "friction": N, "opening": m, "slip": m, "bonded": share}, ...]}

    transformation  for compas.geometry.Transformation: takes the block from where it was built to where it is
    compression     N, resultant of the normal traction, positive where the blocks press on each other; friction is
                    the size of the tangential resultant. Both are means of the tractions times the area.
    """
    joints = snapshot.joints
    blocks = [{"index": i, "transformation": _frame(snapshot, assembly, i).tolist(),
               "displacement": snapshot.displacement[i].tolist()} for i in range(len(assembly))]
    interfaces = []
    for i in range(snapshot.joint_count):
        area = float(joints["area"][i])
        interfaces.append({
            "a": int(joints["a"][i]), "b": int(joints["b"][i]), "polygon": assembly.joint_polygon(i).tolist(),
            "normal": joints["normal"][i].tolist(), "area": area,
            "compression": -float(joints["normal_traction"][i]) * area,
            "friction": float(joints["shear_traction"][i]) * area,
            "opening": float(joints["opening"][i]), "slip": float(joints["slip"][i]),
            "bonded": float(joints["bonded"][i])})
    return {"blocks": blocks, "interfaces": interfaces}
