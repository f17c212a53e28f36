"""Cases: what the program reads from a TOML file, here also as dictionaries."""

import os
import tempfile
import tomllib

from . import _voussoir
from ._assembly import _first
from ._toml import dumps


class Case:
    """A checked case.

    source    path of a case file, or a dictionary with the tables of docs/case-reference.md:
              {"bridge": {...}, "stage": [{"kind": "gravity"}, ...], "output": {...}}. Keys whose value is None are
              left out; numpy arrays and numbers are taken as lists and numbers.
    assembly  for a dictionary without "bridge": the Assembly that the case is about.
    folder    folder that relative names in a dictionary start from.
    geometry  True: for geometry, modes and diagnosis; the case may then have no stage.

    Raises InputError that names the line and the key. A case gives results with the same bits here as with the
    program.
    """

    def __init__(self, source, *, assembly=None, folder=".", geometry=False):
        self._assembly_file = None
        if isinstance(source, dict):
            self._case = self._of_dictionary(source, assembly, folder, geometry)
        elif assembly is not None:
            raise TypeError("a case that is a file names its own bridge: give 'assembly' with a dictionary.")
        else:
            self._case = _voussoir.Case._read(os.fspath(source), geometry)

    @classmethod
    def read(cls, path, *, geometry=False):
        """A case from its file."""
        return cls(path, geometry=geometry)

    def _of_dictionary(self, tables, assembly, folder, geometry):
        if assembly is not None:
            if "bridge" in tables:
                raise TypeError("the dictionary has a 'bridge' and there is an 'assembly' as well: leave one out.")
            self._assembly_file = tempfile.TemporaryDirectory(prefix="voussoir-")
            path = os.path.join(self._assembly_file.name, "assembly.h5")
            assembly.write(path)
            tables = {"bridge": {"assembly": path}, **tables}
        return _voussoir.Case._parse(dumps(tables), os.path.normpath(os.path.join(folder, "case")), geometry)

    @property
    def path(self):
        """Path of the case file. For a case from a dictionary: the name that messages use."""
        return self._case.path

    @property
    def text(self):
        """The TOML text that the case was read from."""
        return self._case.text

    def resolved(self):
        """The case with every key, defaults too, as a dictionary."""
        return tomllib.loads(self._case._resolved())

    def write(self, directory):
        """Writes case.toml with every key, and copies of its records and its assembly file, into a folder."""
        os.makedirs(directory, exist_ok=True)
        self._case._write(os.fspath(directory))

    def assembly(self):
        """The Assembly: generated, or read from its file. May take seconds."""
        return self._case._assembly()

    def remarks(self, assembly):
        """The program's remarks on unusual values of the case and its assembly: [text, ...]."""
        return self._case._remarks(assembly)

    def run(self, directory, *, overwrite=False, until=None, threads=None, pictures=True, progress=True):
        """Runs all stages in a run directory, as `voussoir run` does; returns the Run.

        directory  folder for checkpoints, history, tables, pictures and the page. A folder that contains a run is
                   refused unless `overwrite` is True.
        until      s of simulated time at which to pause with a checkpoint; None: to the end.
        threads    None: all that the machine has. The number changes no bit of the results.
        pictures   False: leave out pictures and page.
        progress   True: a line that keeps changing; False: nothing; or a function of a dictionary (see ProgressBar).

        Ctrl-C stops with a checkpoint and raises KeyboardInterrupt; Run(directory).resume() goes on. Raises RunError
        where the run fails.
        """
        from ._run import Run, _started
        return _started(Run(directory), progress, lambda p: _voussoir._run_case(
            self._case, os.fspath(directory), overwrite, _first(until, -1.0), _first(threads, _voussoir.available_threads()),
            pictures, p))

    def __repr__(self):
        return f"<voussoir.Case {self.path}>"
