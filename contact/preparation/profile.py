"""Preparation of a profile: its form is removed, and short and long waves are filtered (ISO 21920, ISO 16610-21)."""

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.filters import mean_line
from roughfilm.contact.preparation.form import ORDERS
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.surfaces.profile import CONSTANT, Profile

OF_SURFACES = ("outliers", "window", "grid", "edges", "smoothing")
"""Steps of a recipe that a profile does not have."""


def prepare_profile(profile: Profile, recipe: Recipe) -> Profile:
    """Subtract the polynomial of the form, then filter with the nesting indices λs and λc of the recipe.

    The polynomial fits all points by least squares; its order is that of the areal form. The S-filter takes the
    Gaussian mean line of the index ``s_filter``, the L-filter subtracts that of ``l_filter``. Without an L-filter the
    result is the primary profile, with one the roughness profile.

    Raises
    ------
    InputError
        If the recipe sets a step of ``OF_SURFACES``, a nesting index is shorter than the distance of the points or
        longer than the profile, or all heights are equal once the form is removed.
    """
    _refuse_steps_of_surfaces(recipe)
    heights, places = profile.heights, np.linspace(-1, 1, profile.heights.size)
    if recipe.form != "none":
        order = min(ORDERS[recipe.form], heights.size - 1)
        heights = heights - np.polynomial.Legendre.fit(places, heights, order)(places)
    for name, index in (("s_filter", recipe.s_filter), ("l_filter", recipe.l_filter)):
        if index is None:
            continue
        if not profile.spacing * (1 - 1e-9) <= index <= profile.length:
            raise InputError(
                f"{name}: got a nesting index of {index:.4g} m; give one from the distance of the points, "
                f"{profile.spacing:.4g} m, to the length of the profile, {profile.length:.4g} m"
            )
        mean = mean_line(heights, index / profile.spacing)
        heights = mean if name == "s_filter" else heights - mean
    if np.ptp(heights) <= CONSTANT * np.abs(profile.heights).max():
        raise InputError("profile: all heights are the same once its form is removed; there is no roughness")
    scale = {"form": recipe.form, "s_filter": recipe.s_filter, "l_filter": recipe.l_filter}
    return Profile(heights=heights, spacing=profile.spacing, source={**profile.source, "scale": scale})


def _refuse_steps_of_surfaces(recipe: Recipe) -> None:
    given = [step for step in OF_SURFACES if step in recipe.model_fields_set]
    if recipe.s_filter is not None and recipe.smoothing == 1:  # which an S-filter sets
        given = [step for step in given if step != "smoothing"]
    if given:
        raise InputError(
            f"{', '.join(given)}: got for a profile, whose steps are form, s_filter and l_filter; leave "
            f"{'it' if len(given) == 1 else 'them'} out of the recipe"
        )
