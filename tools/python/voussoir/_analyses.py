"""Diagnosis, rating, tables of campaigns."""

import json
import os

from . import _voussoir
from ._assembly import _first
from ._progress import says


class Diagnosis:
    """The result of diagnose().

    verdict    'consistent', 'found' or 'unexplained'
    text       the report in words
    corrected  TOML text of the corrected case
    data       everything, as in diagnosis.json (docs/formats.md)
    """

    def __init__(self, data, text, corrected):
        self.data = json.loads(data)
        self.text = text
        self.corrected = corrected

    @property
    def verdict(self):
        return self.data["verdict"]

    def __repr__(self):
        return self.text


def _case(source):
    from ._case import Case
    return source if isinstance(source, Case) else Case(source, geometry=True)


def diagnose(case, measured, *, directory=None, page=False, hold_back=(), without=(), effects=3, model_error=0.005,
             least_amounts=True, run_seconds=10.0, threads=None, progress=True):
    """Compares a case with measurements and finds the effect that the case lacks. Returns a Diagnosis.

    case           Case, or what Case() takes
    measured       folder with modes.csv, sensors.csv, shapes.csv, records/ (docs/formats.md)
    directory      folder for diagnosis.json and corrected.toml; None: nothing is written
    page           with `directory`: also diagnosis.html with its pictures
    hold_back      names of modes that are predicted, not fitted
    without        names of effects that are not tried
    effects        largest number of effects that are added
    model_error    error of the frequencies of a correct model, as a share, in addition to the error of the mesh
    least_amounts  True: also compute the least amount of each effect that these measurements would show
    run_seconds    s of the first recording with the ground's motion that the explicit solver computes, before and after
                   the correction; 0: none
    threads        None: all that the machine has
    progress       True: a line for each step on standard error; False: nothing; or a function that receives each line

    Ctrl-C stops between two steps. Raises InputError when there is nothing to compare.
    """
    return Diagnosis(*_voussoir._diagnose(
        _case(case)._case, os.fspath(measured), os.fspath(directory) if directory else "", page, list(hold_back),
        list(without), effects, model_error, least_amounts, run_seconds,
        _first(threads, _voussoir.available_threads()), says(progress)))


class Rating:
    """The vehicles that a bridge can carry.

    text  one line for each vehicle: the worst position and the factor there
    data  every position, as in rate.json (docs/formats.md)
    """

    def __init__(self, data, text):
        self.data = json.loads(data)
        self.text = text

    def __repr__(self):
        return self.text


def rate(case, vehicles, *, lanes=(0.0,), both_ways=True, step=None, refinements=2, most=30.0, tolerance=0.05,
         strip=None, effective_width=None, threads=None, progress=True):
    """Computes adequacy factors of vehicles at their worst positions on a bridge (docs/rating.md). Returns a Rating.

    case             Case, or what Case() takes; with a stage that brings it to rest
    vehicles         names of vehicles() or files
    lanes            m, y of the vehicles' middle lines
    both_ways        also driving towards -x, where that is different
    step             m, distance between positions; None: a tenth of the shortest span
    refinements      number of halvings of this distance around the worst position
    most, tolerance  largest factor of the search, and tolerance of the factor
    strip            m: a strip of this width in plane strain instead of the whole bridge
    effective_width  m, width of the bridge that carries a vehicle, with `strip`; None: wheels + 1.5 m + cover
    threads          None: all that the machine has
    progress         True: a line for each position on standard error; False: nothing; or a function that receives each
                     line

    The program applies no dynamic factor. Ctrl-C stops between two positions.
    """
    from ._case import Case
    case = case if isinstance(case, Case) else Case(case)
    names = [vehicles] if isinstance(vehicles, (str, os.PathLike)) else vehicles
    return Rating(*_voussoir._rate(case._case, [os.fspath(v) for v in names], [float(y) for y in lanes], both_ways,
                                   _first(step, 0.0), refinements, most, tolerance, _first(strip, 0.0),
                                   effective_width, _first(threads, _voussoir.available_threads()), says(progress)))


def campaign_table(path):
    """The table of a campaign, one row a run (docs/formats.md).

    path  campaign directory or its table.csv

    Returns a pandas.DataFrame if pandas is installed, else a dictionary of lists and arrays.
    """
    path = os.fspath(path)
    if os.path.isdir(path):
        path = os.path.join(path, "table.csv")
    columns = _voussoir._campaign_table(path)
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)
