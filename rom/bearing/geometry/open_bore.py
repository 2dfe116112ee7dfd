"""The bore of a full journal bearing with the line at its inlet, in coordinates that are fixed to the bore."""

import math
from typing import Self

from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.lobes import DOWN, Lobes
from roughfilm.rom.bearing.geometry.texture import Texture, pocketed
from roughfilm.rom.cavitation.shape import Shape


class OpenBore(Lobes):
    """A full bore that is open in a line along its axis, at which its film has an inlet and an outlet.

    The line lies opposite to ``first``. It is the film of a shaft in lobes, and that of a journal whose widest place
    lies there.

    Attributes
    ----------
    texture : pockets in the bore.
    """

    texture: Texture | None = None

    @classmethod
    def of(cls, journal: Journal, first: float = DOWN) -> Self:
        """The bore of a journal whose shaft is displaced towards an angle, rad, from its inlet."""
        ratio = journal.eccentricity
        along, up = math.cos(first), math.sin(first)
        return cls.model_construct(
            shape="lobes",
            radius=journal.radius,
            clearance=journal.clearance,
            width=journal.width,
            first=first,
            eccentricity=None if ratio is None else (ratio * along, ratio * up),
            texture=journal.texture,
        )

    @property
    def joined(self) -> bool:
        """False: the line at the inlet divides the film."""
        return False

    @property
    def symmetric(self) -> bool:
        """Whether the film is symmetric about the middle of its width; not known of a textured one."""
        return self.texture is None

    def film_shape(self) -> Shape:
        """The shape of the film, with its texture."""
        smooth = super().film_shape()
        return smooth if self.texture is None else pocketed(smooth, self.texture)
