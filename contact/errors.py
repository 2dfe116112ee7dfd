"""The three ways a request can fail; every package raises these and no others on purpose.

They live in the lowest package because every package needs them. Each message is one line that names the
place, the value met there and the remedy.
"""


class InputError(ValueError):
    """What was asked cannot be understood or is out of range: ``place: got value; remedy``."""


class ConvergenceError(RuntimeError):
    """A solver stopped before it met its tolerance, or met it with fields that cannot be trusted."""


class UnavailableError(ImportError):
    """Something this model needs is not on this machine: what, and how to get it."""
