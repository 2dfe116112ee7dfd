"""The residual of a film with other viscosities than those with which it was solved."""

from dataclasses import replace

import numpy as np

from roughfilm.rom.bearing.thermal.field.films import HeatedSolution
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.discretise import network
from roughfilm.rom.cavitation.evaluation.flows import flow_across, flow_along, node_balances
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.solve import Solution


def residual_of(solution: Solution, viscosities: Viscosities) -> float:
    """The largest net flow into a node of a film over the largest flow through a face, with given viscosities.

    Parameters
    ----------
    viscosities : viscosities at the nodes.
    """
    problem, before = replace(solution.problem, at_nodes=viscosities), solution.network
    net = network(
        solution.grid,
        solution.faces,
        problem.ends,
        speed=problem.speed,
        viscosity=problem.viscosity,
        compressibility=problem.initial_compressibility,
        ruptures=before.part_couette.size > 0,
        viscosities=viscosities,
    )
    varied = replace(solution, problem=problem, network=replace(net, storage=before.storage, stored=before.stored))
    net_flows = node_balances(varied)
    if net.supply is not None:
        net_flows[0] -= net.supply
    balances = np.abs(net_flows[(solution.kind == FILM) | (solution.kind == CAVITY)])
    along, across = flow_along(varied), flow_across(varied)
    if not before.periodic[0]:
        along = along[:-1]
    largest = max(float(np.abs(along).max()), float(np.abs(across[:, :-1]).max(initial=0.0)))
    return float(balances.max(initial=0.0)) / (largest or 1.0)


def iteration(solution: HeatedSolution) -> dict[str, float]:
    """The numbers of the iteration of a film and its viscosities.

    ``viscosity_change`` is the root mean square of the difference of ln η between the film and its viscosities,
    ``largest_viscosity_change`` the largest one at a node, ``coupled_residual`` the residual of the film with these
    viscosities, and ``contraction`` the mean ratio of successive differences.
    """
    return {
        "viscosity_change": solution.changes[-1],
        "largest_viscosity_change": solution.largest,
        "coupled_residual": residual_of(solution, solution.heated.viscosities),
        "contraction": solution.contraction,
    }
