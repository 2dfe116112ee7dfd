"""The numerical options of one solve, as requested and as checked by a model."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Request:
    """Numerical options of one solve, which ``Model.solve`` checks; the physics is in the scene.

    Parameters
    ----------
    resolution : number of cells, points or nodes that the model's ``resolution_meaning`` names; None for its default.
    tolerance : residual at which the solver stops, in the model's ``residual_meaning``; None for its default.
    scheme : advection scheme, one of the model's ``schemes``; None for the first of them.
    processes : number of MPI processes of an OpenFOAM run; all other models run in one process.

    Examples
    --------
    >>> Request(resolution=200, scheme="upwind")
    Request(resolution=200, tolerance=None, scheme='upwind', processes=1)
    """

    resolution: int | None = None
    tolerance: float | None = None
    scheme: str | None = None
    processes: int = 1


@dataclass(frozen=True, kw_only=True)
class CheckedRequest:
    """Numerical options in the ranges that a model allows, with its defaults filled in.

    Attributes
    ----------
    resolution : number of cells, points or nodes that the model's ``resolution_meaning`` names.
    tolerance : residual at which the solver stops.
    scheme : advection scheme; "" for a model that offers no choice.
    processes : number of processes.
    asked : the request before the defaults were filled in.
    """

    resolution: int
    tolerance: float
    scheme: str
    processes: int
    asked: Request
