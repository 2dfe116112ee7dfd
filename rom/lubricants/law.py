"""The base class of the laws of a lubricant."""

import math

from roughfilm.contact.foundation.entries import Part


class LubricantLaw(Part):
    """A law over the pressure above cavitation pressure."""

    @property
    def valid_to(self) -> float:
        """The highest valid pressure, Pa; above it a result has a warning."""
        return math.inf
