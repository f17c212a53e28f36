"""Run directories, which the program or Case.run() writes."""

import base64
import json
import os

from . import _voussoir
from ._assembly import _first
from ._case import Case
from ._progress import bar_of, ended
from ._snapshot import Snapshot


def _started(run, progress, work):
    bar = bar_of(progress)
    try:
        work(bar)
    finally:
        ended(bar)
    return run


class History:
    """Time series of a run: history["time"] and others are arrays; `units` says their units."""

    def __init__(self, columns):
        self.units = {name: unit for name, (unit, _) in columns.items()}
        self._values = {name: values for name, (_, values) in columns.items()}

    def __getitem__(self, channel):
        try:
            return self._values[channel]
        except KeyError:
            raise KeyError(f"{channel}: the channels are {', '.join(self._values)}.") from None

    def __contains__(self, channel):
        return channel in self._values

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def keys(self):
        """Names of the channels."""
        return self._values.keys()

    def frame(self):
        """All channels as a pandas.DataFrame."""
        import pandas
        return pandas.DataFrame(self._values)


class Run:
    """A run directory.

    directory  folder that `voussoir run` or Case.run() wrote, finished or not
    """

    def __init__(self, directory):
        self.directory = os.fspath(directory)

    def _path(self, *names):
        return os.path.join(self.directory, *names)

    @property
    def case(self):
        """The Case with every key, as it was run."""
        return Case(self._path("case.toml"))

    @property
    def assembly(self):
        """The Assembly."""
        return _voussoir.Assembly.read(self._path("assembly.h5"))

    @property
    def summary(self):
        """summary.json as a dictionary (docs/formats.md)."""
        with open(self._path("summary.json"), encoding="utf-8") as file:
            return json.load(file)

    @property
    def history(self):
        """Time series, a History."""
        return History(_voussoir._history(self._path("history.h5")))

    def state(self, checkpoint=None):
        """The Snapshot of a checkpoint file; None: of the newest."""
        return Snapshot(_voussoir._stored_state(os.fspath(_first(checkpoint, self.directory))))

    def resume(self, *, until=None, threads=None, pictures=True, progress=True):
        """Continues from the newest checkpoint. The results have the same bits as those of a run that was not stopped.

        The arguments are those of Case.run().
        """
        return _started(self, progress, lambda p: _voussoir._resume_run(
            self.directory, _first(until, -1.0), _first(threads, _voussoir.available_threads()), pictures, p))

    def images(self):
        """Paths of the pictures, by name."""
        folder = self._path("images")
        if not os.path.isdir(folder):
            return []
        return sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.endswith((".png", ".svg")))

    def _repr_html_(self):
        pictures = [p for p in self.images() if p.endswith(".png")]
        best = [p for p in pictures if os.path.basename(p).startswith(("final", "end"))] or pictures
        text = f"<p>voussoir run <code>{self.directory}</code></p>"
        if not best:
            return text
        with open(best[0], "rb") as file:
            return text + f'<img alt="{os.path.basename(best[0])}" src="data:image/png;base64,{base64.b64encode(file.read()).decode()}">'

    def __repr__(self):
        return f"<voussoir.Run {self.directory}>"
