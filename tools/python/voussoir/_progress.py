"""Lines that show the progress of runs and analyses."""

import sys
import time


def _duration(seconds):
    seconds = int(round(seconds))
    if seconds < 60:
        return f"{seconds} s"
    if seconds < 3600:
        return f"{seconds // 60} min {seconds % 60:02} s"
    return f"{seconds // 3600} h {seconds // 60 % 60:02} min"


class ProgressBar:
    """A line on `stream` (standard error) that keeps changing; works in a terminal and in a notebook.

    A run calls it with a dictionary: stage (text), timed (whether the stage takes simulated time), time and end (s of
    simulated time), share (of the run), speed (simulated over wall-clock time), left (s of wall-clock time), note
    (text, for example the state of the iteration).
    """

    width = 24
    every = 0.2  # s

    def __init__(self, stream=None):
        self._stream = stream or sys.stderr
        self._shown = 0.0
        self._length = 0
        self._stage = None

    def __call__(self, progress):
        now = time.monotonic()
        if now - self._shown < self.every and progress["stage"] == self._stage:
            return
        self._shown, self._stage = now, progress["stage"]
        text = progress["stage"]
        if progress["timed"] and progress["end"] > 0.0:
            share = min(max(progress["share"], 0.0), 1.0)
            done = int(share * self.width)
            text += (f"  [{'#' * done}{'.' * (self.width - done)}] {100 * share:3.0f} %"
                     f"  t = {progress['time']:.2f} of {progress['end']:.2f} s")
            if progress["speed"] > 0.0:
                text += f"  {_duration(max(progress['left'], 0.0))} left"
        elif progress["note"]:
            text += f"  {progress['note']}"
        self._write(text)

    def _write(self, text):
        self._stream.write("\r" + text + " " * max(self._length - len(text), 0))
        self._length = len(text)
        self._stream.flush()

    def end(self):
        """Takes the line away."""
        if self._length:
            self._write("")
            self._stream.write("\r")
            self._stream.flush()
        self._length = 0


def bar_of(progress):
    """The function to call for progress=True, a function, or nothing."""
    if progress is True:
        return ProgressBar()
    return progress or None


def ended(bar):
    if isinstance(bar, ProgressBar):
        bar.end()


def says(progress):
    """The function that lines of words go to."""
    if progress is True:
        return lambda line: print(line, file=sys.stderr, flush=True)
    return progress or None
