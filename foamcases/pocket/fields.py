"""Read the fields of a finished pocket case as arrays over columns and layers."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import finite_arithmetic
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.foamcases.conformal.channel import Channel
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.fields import internal_field, last_fields, points
from roughfilm.foamcases.pocket.card import Card


def read_channel(directory: Path) -> Channel:
    """Read the last fields of a case.

    Raises
    ------
    InputError
        If the directory holds no pocket case of this version.
    ConvergenceError
        If the directory holds no finished fields, or fields that are not finite.
    """
    card = read_card(directory, Card)
    shape, nodes = (card.columns, card.layers), (card.columns + 1, card.layers + 1, 2)
    try:
        corners = points(directory / "constant" / "polyMesh" / "points", math.prod(nodes))
        last, cells = last_fields(directory), card.columns * card.layers
        velocity = internal_field(last / "U", 3, cells).reshape(*shape, 3, order="F")[..., :2]
        pressure = internal_field(last / "p", 1, cells).reshape(shape, order="F")
    except InputError as error:
        raise ConvergenceError(f"{directory}: holds no finished fields ({error})") from error
    vertices = corners.reshape(*nodes, 3, order="F")[:, :, 0, :2]
    with finite_arithmetic(str(directory)):
        up, down = vertices[1:, 1:] - vertices[:-1, :-1], vertices[:-1, 1:] - vertices[1:, :-1]
        if not (up[..., 0] * down[..., 1] - up[..., 1] * down[..., 0] > 0).all():
            raise InputError(f"{directory}: a cell of the mesh has no area; generate the case again")
        channel = Channel(vertices=vertices, velocity=velocity, pressure=pressure * card.reynolds_number)
        first, last_column = np.diff(vertices[:, -1, 0])[[0, -1]] / 2
        wall = channel.wall_pressure
        boundary = (wall[0] * last_column + wall[-1] * first) / (first + last_column)
        return replace(channel, pressure=channel.pressure - boundary)
