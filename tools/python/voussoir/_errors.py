"""Errors a person can act on."""

import atexit

from . import _voussoir


class InputError(ValueError):
    """The input is wrong. The text says place, value found, value expected and remedy."""


class RunError(RuntimeError):
    """The input was accepted but the work failed: no equilibrium, a full disk, a damaged file."""


InputError.__module__ = RunError.__module__ = "voussoir"
_voussoir._set_errors(InputError, RunError)
atexit.register(_voussoir._forget_errors)
