"""Synthetic surfaces described by a TOML table."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, TypeAdapter, ValidationError

from roughfilm.contact.foundation.entries import Angle, Coordinate, Length, Part, PositiveNumber, plain_number
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.faults import faults_of, in_lines, unknown_key
from roughfilm.contact.foundation.line_numbers import Location
from roughfilm.contact.foundation.toml import read_toml
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.cross_hatch import cross_hatch
from roughfilm.contact.synthetic.distribution import rms_slope, with_skewness
from roughfilm.contact.synthetic.gaussian import Autocorrelation, gaussian
from roughfilm.contact.synthetic.grid import metres
from roughfilm.contact.synthetic.milled import milled
from roughfilm.contact.synthetic.plateau_honed import plateau_honed
from roughfilm.contact.synthetic.random_field import Mode, Population, SpectrumTable, random_field
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.contact.synthetic.sinusoids import Combination, sinusoid
from roughfilm.contact.synthetic.waves import Amplitudes


def _whole(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"got {value!r}; write a whole number, without quotes")
    return value


Whole = Annotated[int, BeforeValidator(_whole)]
Number = Annotated[float, BeforeValidator(plain_number)]


class HeightDistribution(Part):
    """Skewness Ssk of the heights, see ``roughfilm.contact.synthetic.distribution.with_skewness``.

    Attributes
    ----------
    skewness : skewness Ssk of the heights.
    """

    skewness: Number


class _Described(Part):
    """The entries of every description.

    Attributes
    ----------
    kind : kind of the surface.
    size : lengths of the period along x and y, m.
    points : numbers of points along x and y.
    """

    kind: str
    size: tuple[Length, Length]
    points: tuple[Whole, Whole]


class SelfAffine(_Described):
    """A self-affine surface, see ``roughfilm.contact.synthetic.self_affine``.

    Attributes
    ----------
    seed : seed of the random numbers.
    hurst : Hurst exponent.
    roll_off : wavelength above which the spectrum is flat, m.
    cut_off : shortest wavelength, m.
    rms_height : rms height, m; or give rms_slope.
    rms_slope : rms slope, in place of rms_height.
    amplitudes : "fixed" or "random" amplitudes of the waves.
    height_distribution : skewness of the heights; without it they are Gaussian.
    """

    kind: Literal["self_affine"]
    seed: Whole
    hurst: PositiveNumber
    roll_off: Length
    cut_off: Length
    rms_height: Length | None = None
    rms_slope: PositiveNumber | None = None
    amplitudes: Amplitudes = "fixed"
    height_distribution: HeightDistribution | None = None


class Gaussian(_Described):
    """A surface with a Gaussian or exponential autocorrelation, see ``roughfilm.contact.synthetic.gaussian``.

    Attributes
    ----------
    seed : seed of the random numbers.
    rms_height : rms height, m.
    correlation_length : correlation length, m.
    anisotropy : ratio of the correlation lengths along and across the lay.
    lay_angle : angle of the lay, rad.
    autocorrelation : shape of the autocorrelation.
    amplitudes : "fixed" or "random" amplitudes of the waves.
    height_distribution : skewness of the heights; without it they are Gaussian.
    """

    kind: Literal["gaussian"]
    seed: Whole
    rms_height: Length
    correlation_length: Length
    anisotropy: PositiveNumber = 1.0
    lay_angle: Angle = 0.0
    autocorrelation: Autocorrelation = "gaussian"
    amplitudes: Amplitudes = "fixed"
    height_distribution: HeightDistribution | None = None


class Sinusoid(_Described):
    """Waves along x and y, see ``roughfilm.contact.synthetic.sinusoids``.

    Attributes
    ----------
    amplitude : amplitude, m.
    wavelength_x : wavelength along x, m; without it constant along x.
    wavelength_y : wavelength along y, m; without it constant along y.
    combination : product or sum of the waves along x and y.
    """

    kind: Literal["sinusoid"]
    amplitude: Length
    wavelength_x: Length | None = None
    wavelength_y: Length | None = None
    combination: Combination = "product"


class CrossHatch(_Described):
    """A cross-hatched surface, see ``roughfilm.contact.synthetic.cross_hatch``.

    Attributes
    ----------
    spacing : distance of the grooves, m.
    half_angle : angle between the grooves and the x axis, rad.
    depth : depth of a groove, m.
    width : width of a groove, m.
    """

    kind: Literal["cross_hatch"]
    spacing: Length
    half_angle: Angle
    depth: Length
    width: Length


class Milled(_Described):
    """A milled surface, see ``roughfilm.contact.synthetic.milled``.

    Attributes
    ----------
    radius : radius of the circle of the cutting edge, m.
    feed : feed per revolution, m.
    depth : depth from arc to cusp, m.
    offset : distance of the centre from the middle of the width, m.
    back_lift : height of the back of the mill above its front, m; 0 for equal crossing marks.
    """

    kind: Literal["milled"]
    radius: Length
    feed: Length
    depth: Length
    offset: Coordinate = 0.0
    back_lift: Coordinate | None = None


class PlateauHoned(_Described):
    """A plateau-honed surface, see ``roughfilm.contact.synthetic.plateau_honed``.

    Attributes
    ----------
    seed : seed of the random numbers.
    plateau_rms_height : rms height of the plateaus, m.
    plateau_correlation_length : correlation length of the plateaus, m.
    valley_rms_height : rms height of the valleys, m.
    valley_correlation_length : correlation length of the valleys, m.
    material_ratio : material ratio at which plateaus and valleys meet.
    valley_anisotropy : ratio of the lengths of the valleys along and across.
    half_angle : angle between the valleys and the x axis, rad.
    """

    kind: Literal["plateau_honed"]
    seed: Whole
    plateau_rms_height: Length
    plateau_correlation_length: Length
    valley_rms_height: Length
    valley_correlation_length: Length
    material_ratio: PositiveNumber
    valley_anisotropy: PositiveNumber = 1.0
    half_angle: Angle = 0.0


class RandomField(_Described):
    """A surface that scatters as the windows of a measurement, see ``roughfilm.contact.synthetic.random_field``.

    Attributes
    ----------
    seed : seed of the random numbers.
    spectrum : mean power of single waves.
    population : powers of the octaves and distribution of heights, and how they differ between windows.
    """

    kind: Literal["random_field"]
    seed: Whole
    spectrum: SpectrumTable
    population: Population


Description = SelfAffine | Gaussian | Sinusoid | CrossHatch | Milled | PlateauHoned | RandomField

KINDS: Mapping[str, tuple[type[BaseModel], Callable[..., Surface]]] = {
    "self_affine": (SelfAffine, self_affine),
    "gaussian": (Gaussian, gaussian),
    "sinusoid": (Sinusoid, sinusoid),
    "cross_hatch": (CrossHatch, cross_hatch),
    "milled": (Milled, milled),
    "plateau_honed": (PlateauHoned, plateau_honed),
    "random_field": (RandomField, random_field),
}

TABLES: Mapping[str, type[BaseModel]] = {
    "height_distribution": HeightDistribution,
    "spectrum": SpectrumTable,
    "population": Population,
    "modes": Mode,
}
"""The tables within descriptions."""

_READER: TypeAdapter[Description] = TypeAdapter(
    Annotated[Description, Field(discriminator="kind")], config=ConfigDict(defer_build=True)
)


def read_description(path: Path) -> Description:
    """Read the description of a surface from a TOML file.

    The keys are ``kind`` and the arguments of the function of that kind, lengths and angles with units ("1 mm",
    "30 deg"). "self_affine" and "gaussian" also take a table ``[height_distribution]`` with ``skewness``;
    "random_field" has tables ``[spectrum]`` and ``[population]``, which ``roughfilm fit`` writes.

    Raises
    ------
    InputError
        If the file cannot be read, or a key is unknown, missing or has an invalid value; the message names the key.
    """
    return read_entries(read_toml(path, 'kind = "self_affine"'))


def read_entries(entries: Mapping[str, Any]) -> Description:
    """The description from entries of a TOML file, or from ``source["synthetic"]`` of a surface.

    Raises
    ------
    InputError
        As ``read_description`` does.
    """
    try:
        return _READER.validate_python(entries)
    except ValidationError as error:

        def unknown(location: Location) -> tuple[str, str]:
            _, *table, key = location
            named = [TABLES[str(part)] for part in table if part in TABLES]
            return unknown_key(key, (named[-1] if named else KINDS[entries["kind"]][0]).model_fields)

        raise InputError(in_lines(faults_of(error, unknown, lambda location: location[1:]), "surface")) from None


def description_entries(description: Description) -> dict[str, Any]:
    """The complete description as entries, with defaults, units as text; ``read_entries`` reads it back unchanged."""
    return description.model_dump(mode="json", exclude_none=True)


def make(description: Description) -> Surface:
    """Generate the periodic surface of a description; equal descriptions give equal bytes.

    A height distribution keeps the rms height or, if the description gives it, the rms slope.

    Returns
    -------
    Surface : ``source["synthetic"]`` holds the complete description, ``source["achieved"]`` the values achieved, and
        ``source["distribution"]`` the results of a height distribution.

    Raises
    ------
    InputError
        If an argument is out of range; see the function of the kind.
    """
    given = {name: getattr(description, name) for name in type(description).model_fields}
    kind, distribution = given.pop("kind"), given.pop("height_distribution", None)
    surface = KINDS[kind][1](**given)
    if distribution is None:
        return surface
    shaped = with_skewness(surface, distribution.skewness)
    slope = rms_slope(shaped)
    wanted = given.get("rms_slope") or slope
    heights = shaped.heights * (wanted / slope)
    achieved = {**surface.source["achieved"], "rms_height": metres(heights.std()), "rms_slope": wanted}
    return shaped.with_heights(
        heights,
        source={**shaped.source, "synthetic": description_entries(description), "achieved": achieved},
    )
