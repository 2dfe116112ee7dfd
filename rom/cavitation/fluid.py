"""The interface of a lubricant that the solvers use."""

from typing import Protocol

from roughfilm.contact.foundation.arrays import Array


class Fluid(Protocol):
    """Density and viscosity over pressure; arrays have the shape of ``pressure``, Pa above cavitation pressure."""

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa."""
        ...

    def mobility(self, pressure: Array) -> tuple[Array, Array]:
        """φ = θ η0/η and dφ/dp, 1/Pa."""
        ...
