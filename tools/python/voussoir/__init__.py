"""voussoir: masonry arch bridges, stone by stone.

Every block is a rigid body. Every joint can open, slide and break. A fill can be a continuum. Cases are those of the
program (docs/case-reference.md), as files or as dictionaries. The results have the same bits as those of the program.

    import voussoir as vs

    case = vs.Case({"bridge": {"generator": "arch"}, "stage": [{"kind": "gravity"}]})
    run = vs.Simulation(case)
    run.run()
    print(run.snapshot().joints["opening"].max())

SI units throughout: m, kg, s, N, Pa; angles in degrees in cases, rotations as quaternions (w, x, y, z).
"""

import os as _os

# Waiting threads sleep instead of spinning, as in the program; read when the library of threads is loaded.
_os.environ.setdefault("OMP_WAIT_POLICY", "passive")

try:
    from . import _voussoir
except ImportError as _error:
    from ._why import why_not
    raise ImportError(why_not(_error)) from _error
from ._errors import InputError, RunError
from ._voussoir import Assembly, available_threads, build_info, component_names, vehicles
from ._assembly import assembly_from_blocks, import_blocks
from ._case import Case
from ._snapshot import Snapshot
from ._simulation import Simulation
from ._run import History, Run
from ._modal import Modes, modal
from ._analyses import Diagnosis, Rating, campaign_table, diagnose, rate
from ._progress import ProgressBar
from ._draw import draw
from . import compas

__version__: str = _voussoir.version

__all__ = [
    "Assembly", "Case", "Diagnosis", "History", "InputError", "Modes", "ProgressBar", "Rating", "Run", "RunError", "Simulation",
    "Snapshot", "assembly_from_blocks", "available_threads", "build_info", "campaign_table", "compas",
    "component_names", "diagnose", "draw", "import_blocks", "modal", "rate", "vehicles",
]
