"""The options of a command checked against its scene."""

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.seal.scene import Seal
from roughfilm.terminal.ranges import loads_of


def seal_of(scene: Scene) -> Seal:
    """The scene, if it is a seal; InputError otherwise."""
    if not isinstance(scene, Seal):
        raise InputError(f"scene.kind: got {scene.kind!r}; leakage takes scenes of kind 'seal'")
    return scene


def bearing_of(scene: Scene) -> Bearing:
    """The scene, if it is a bearing; InputError otherwise."""
    if not isinstance(scene, Bearing):
        raise InputError(
            f"scene.kind: got {scene.kind!r}; this command takes scenes of kind 'bearing', such as "
            "scripts/examples/scenes/rough_washer.toml"
        )
    return scene


def requested_loads(loads: str, seal: Seal) -> tuple[float, ...]:
    """The loads of ``--loads``, Pa; InputError if the solids of the seal cannot carry them."""
    requested = loads_of(loads)
    if requested[-1] > seal.hardness:
        raise InputError(
            f"--loads: up to {requested[-1] / 1e6:.10g} MPa, above the hardness of {seal.hardness / 1e6:.10g} MPa, "
            "which is the largest mean pressure that the whole area can carry; lower them"
        )
    return requested


def refuse_jobs(jobs: int | None) -> None:
    """Raise InputError if ``--jobs`` is given without windows to be run in several processes."""
    if jobs is not None:
        raise InputError(f"--jobs: got {jobs} without a set of windows, which alone runs in several processes; add one")
