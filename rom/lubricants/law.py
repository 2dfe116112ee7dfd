"""What all laws of a lubricant have in common."""

import math

from roughfilm.contact.foundation.entries import Part


class Law(Part):
    """A law over the pressure above that of cavitation; ``valid_to`` is the highest for which it is meant, Pa."""

    @property
    def valid_to(self) -> float:
        """Beyond it an answer comes with a warning."""
        return math.inf
