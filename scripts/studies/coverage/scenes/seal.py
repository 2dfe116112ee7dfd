"""Random seals: surfaces from files, from wide open to nearly closed, one to twelve periods long."""

from numpy.random import Generator

from scripts.studies.coverage.random_entries import Entries, length
from scripts.studies.coverage.scenes.dry_contact import pressed
from scripts.studies.coverage.surfaces import SIDE


def draw(rng: Generator) -> Entries:
    """Return a seal of 48² points with P/(E* g') = 0.003 to 0.4, with water through one to twelve periods."""
    return {
        **pressed(rng, 48, (3e-3, 0.4)),
        "liquid": {"density": "1000 kg/m^3", "viscosity": "1 mPa*s"},
        "flow": {
            "pressure_drop": "1 MPa",
            "length": length(SIDE * int(rng.integers(1, 13))),
            "direction": str(rng.choice(["x", "y"])),
        },
    }
