"""The cells of a film in plan."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """The cells of a periodic film in plan, in film thicknesses.

    Pressures lie at the nodes (x_i, y_j), velocities along x halfway to the node ahead along x, velocities along y
    halfway to the node ahead along y.

    Attributes
    ----------
    nodes : node positions along x and y, each with both ends of the period.
    thickness : film thickness at the places of u and v, at the nodes, and halfway ahead along both axes, shape
        (4, nx, ny).
    rows : along x and along y the distances to the node ahead, those between the places halfway, and weights of the
        second cell in a reconstruction from one side: from behind and ahead at a node, from behind and ahead halfway,
        shape (6, n).
    """

    nodes: tuple[Array, Array]
    thickness: Array
    rows: tuple[Array, Array]

    @property
    def area_u(self):
        return self.rows[0][0][:, None] * self.rows[1][1]

    @property
    def area_v(self):
        return self.rows[0][1][:, None] * self.rows[1][0]

    @property
    def area_p(self):
        return self.rows[0][1][:, None] * self.rows[1][1]

    @property
    def middles(self):
        return tuple((nodes[1:] + nodes[:-1]) / 2 for nodes in self.nodes)


def axis_rows(nodes: Array, second_order: bool) -> Array:
    lengths = np.diff(nodes)
    before, after = np.roll(lengths, 1), np.roll(lengths, -1)
    order = 1.0 if second_order else 0.0
    return np.stack(
        [
            lengths,
            (lengths + before) / 2,
            order * lengths / (lengths + before),
            order * lengths / (lengths + after),
            order * lengths / (2 * before),
            order * before / (2 * lengths),
        ]
    )


def sheet(plan, nodes_x: Array, nodes_y: Array, *, second_order: bool = True) -> Sheet:
    x, y = nodes_x[:-1], nodes_y[:-1]
    xm, ym = (nodes_x[1:] + x) / 2, (nodes_y[1:] + y) / 2

    def h(x, y):
        return np.broadcast_to(plan.thickness(x[:, None] * plan.film, y * plan.film) / plan.film, (x.size, y.size))

    return Sheet(
        nodes=(nodes_x, nodes_y),
        thickness=np.stack([h(xm, y), h(x, ym), h(x, y), h(xm, ym)]),
        rows=(axis_rows(nodes_x, second_order), axis_rows(nodes_y, second_order)),
    )
