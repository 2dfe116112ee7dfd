"""Thin liquid films between rough surfaces, by a ladder of models from Reynolds to Navier-Stokes in OpenFOAM.

Examples
--------
>>> import roughfilm as rf
>>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml", set={"geometry.depth": "22.5 um"})
>>> result = rf.solve(scene, model="film_slope")
>>> result["load"].unit
'Pa'
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roughfilm.contact.foundation.errors import ConvergenceError as ConvergenceError
    from roughfilm.contact.foundation.errors import InputError as InputError
    from roughfilm.contact.foundation.errors import UnavailableError as UnavailableError
    from roughfilm.contact.foundation.units import Quantity as Quantity
    from roughfilm.contact.surfaces.surface import Surface as Surface
    from roughfilm.interface.cases import collect_study as collect_study
    from roughfilm.interface.cases import write_case as write_case
    from roughfilm.interface.cases import write_study as write_study
    from roughfilm.interface.curves import dynamics as dynamics
    from roughfilm.interface.curves import effects as effects
    from roughfilm.interface.curves import leakage_curve as leakage_curve
    from roughfilm.interface.curves import stribeck as stribeck
    from roughfilm.interface.fitting import fit_description as fit_description
    from roughfilm.interface.motion import march as march
    from roughfilm.interface.profiles import fit_profile as fit_profile
    from roughfilm.interface.profiles import read_profile as read_profile
    from roughfilm.interface.results import load_result as load_result
    from roughfilm.interface.results import save as save
    from roughfilm.interface.scenes import load_scene as load_scene
    from roughfilm.interface.scenes import read_scene as read_scene
    from roughfilm.interface.scenes import replace as replace
    from roughfilm.interface.solving import advise as advise
    from roughfilm.interface.solving import compare as compare
    from roughfilm.interface.solving import models as models
    from roughfilm.interface.solving import solve as solve
    from roughfilm.interface.studies import load_study as load_study
    from roughfilm.interface.studies import read_table as read_table
    from roughfilm.interface.studies import run_study as run_study
    from roughfilm.interface.surfaces import combine as combine
    from roughfilm.interface.surfaces import flow_factors as flow_factors
    from roughfilm.interface.surfaces import parameters as parameters
    from roughfilm.interface.surfaces import prepare as prepare
    from roughfilm.interface.surfaces import press as press
    from roughfilm.interface.surfaces import profile_parameters as profile_parameters
    from roughfilm.interface.surfaces import read_surface as read_surface
    from roughfilm.interface.sweeps import sweep as sweep
    from roughfilm.interface.windows import windows as windows
    from roughfilm.rom.ladder.kind import Scene as Scene
    from roughfilm.rom.ladder.result import Field as Field
    from roughfilm.rom.ladder.result import Result as Result

    __version__: str
else:
    _MODULES = {
        "contact.foundation.errors": ("ConvergenceError", "InputError", "UnavailableError"),
        "contact.foundation.units": ("Quantity",),
        "contact.surfaces.surface": ("Surface",),
        "interface.cases": ("collect_study", "write_case", "write_study"),
        "interface.curves": ("dynamics", "effects", "leakage_curve", "stribeck"),
        "interface.fitting": ("fit_description",),
        "interface.motion": ("march",),
        "interface.profiles": ("fit_profile", "read_profile"),
        "interface.results": ("load_result", "save"),
        "interface.scenes": ("load_scene", "read_scene", "replace"),
        "interface.solving": ("advise", "compare", "models", "solve"),
        "interface.studies": ("load_study", "read_table", "run_study"),
        "interface.surfaces": (
            "combine",
            "flow_factors",
            "parameters",
            "prepare",
            "press",
            "profile_parameters",
            "read_surface",
        ),
        "interface.sweeps": ("sweep",),
        "interface.windows": ("windows",),
        "rom.ladder.kind": ("Scene",),
        "rom.ladder.result": ("Field", "Result"),
    }
    _MODULE = {name: module for module, names in _MODULES.items() for name in names}
    __all__ = [*sorted(_MODULE), "__version__"]

    def __getattr__(name: str) -> object:
        """The public name, whose module is imported when it is first used."""
        if name == "__version__":
            from importlib.metadata import version

            return version("roughfilm")
        if name not in _MODULE:
            raise AttributeError(f"module 'roughfilm' has no attribute {name!r}")
        from importlib import import_module

        value = globals()[name] = getattr(import_module(f"roughfilm.{_MODULE[name]}"), name)
        return value

    def __dir__() -> list[str]:
        """The public names."""
        return __all__
