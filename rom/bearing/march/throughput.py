"""What flows through the edges of a film over time, consistent with what the film stores."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.march.numbers import ENTERING
from roughfilm.rom.bearing.march.series import Series


def flows_of(series: Series) -> tuple[str, ...]:
    """The names of the flows through the edges and the supplies of a film."""
    return tuple(name for name in series.units if name.endswith("_flow") or "_flow_" in name)


def throughput(series: Series) -> dict[str, Array]:
    """What has flowed through each place since the first step, m³ (m²), over the steps, by the name of the flow.

    A flow q₊ at the end of a step balances the rate of the volume by the formula of the step. With the ratio r of the
    step to the one before, the two-step formula is

        q₊ = ((1 + 2r) V₊ - r² V)/((1 + r) Δt)

    for the volumes V₊ and V that pass in this step and in the one before, and q₊ = V₊/Δt is that of first order; each
    flow has its own V₊. Their sum is what the film stores. Where a cavity closes, it fills by a formula of its own
    (:func:`roughfilm.rom.cavitation.motion.closing.refilling`), and the sum lacks a part of that, which passes where
    the flows change. A sum of q₊ Δt would miss up to half of what a cavity takes up in its last step.

    Returns
    -------
    dict
        The volume by the name of each flow, in the direction of the flow, 0 at the first step; empty without flows.
    """
    if not (names := flows_of(series)):
        return {}
    ways = np.array([1.0 if name.startswith(ENTERING) else -1.0 for name in names])
    flows = np.array([series[name] for name in names]).T
    stored, steps = np.diff(series["volume"]), np.diff(series.time)
    elsewhere = series["volume_rate"] - flows @ ways  # what refills cavities from the surroundings
    changes = np.abs(np.diff(np.column_stack([flows, elsewhere]), axis=0))
    shares = np.divide(changes, changes.sum(axis=1, keepdims=True), out=np.zeros_like(changes), where=changes > 0)
    signed = ways * shares[:, :-1]
    volumes, volume, before = np.zeros_like(flows), np.zeros(len(names)), 0.0
    for n, step in enumerate(steps):
        ratio = step / steps[n - 1] if series["order"][n + 1] > 1 else 0.0
        rate, memory = step * (1 + ratio) / (1 + 2 * ratio), ratio**2 / (1 + 2 * ratio)
        missing = stored[n] - rate * series["volume_rate"][n + 1] - memory * before
        volume = rate * flows[n + 1] + memory * volume + missing * signed[n]
        volumes[n + 1], before = volumes[n] + volume, stored[n]
    return dict(zip(names, volumes.T, strict=True))
