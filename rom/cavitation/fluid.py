"""What the solvers ask of a lubricant."""

from typing import Protocol

from roughfilm.contact.foundation.arrays import Array


class Fluid(Protocol):
    """What pressure does to a lubricant; arrays have the shape of ``pressure``, Pa above that of cavitation."""

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa."""
        ...

    def mobility(self, pressure: Array) -> tuple[Array, Array]:
        """φ = θ η0/η and dφ/dp, 1/Pa."""
        ...
