"""Definitions of the roughness parameters: names, meanings, equations, units, standards and accuracy, as data.

The terminal, the page of a surface and the manual take them from here.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

Group = Literal["height", "functional", "volume", "hybrid", "spatial", "feature"]

GROUPS: Mapping[Group, str] = {
    "height": "heights",
    "functional": "bearing curve",
    "volume": "volumes",
    "hybrid": "slopes",
    "spatial": "lengths and directions",
    "feature": "peaks and pits",
}
"""Groups of parameters in the order of the tables, with their headings."""

SECOND_ORDER = "second order in the spacing"
CURVE = "second order in 1/n"
SOURCE = "F. Sahlin, Luleå 2008"


@dataclass(frozen=True, kw_only=True)
class Definition:
    """The definition of a roughness parameter.

    Attributes
    ----------
    name : such as "Sdq".
    group : group of the tables.
    meaning : a few words.
    equation : defining equation in LaTeX.
    unit : SI unit, "1" of a plain number.
    standard : standard and clause, or other source.
    accuracy : discretisation error.
    """

    name: str
    group: Group
    meaning: str
    equation: str
    unit: str
    standard: str
    accuracy: str


def _defined(
    group: Group, name: str, meaning: str, equation: str, unit: str, source: str, accuracy: str
) -> tuple[str, Definition]:
    standard = f"ISO 25178-2:2021, {source}" if source[0].isdigit() else source
    return name, Definition(
        name=name, group=group, meaning=meaning, equation=equation, unit=unit, standard=standard, accuracy=accuracy
    )


AREAL: Mapping[str, Definition] = dict(
    (
        _defined("height", "Sa", "mean absolute height", r"\langle |z| \rangle", "m", "4.2", SECOND_ORDER),
        _defined("height", "Sq", "root mean square height", r"\sqrt{\langle z^2 \rangle}", "m", "4.2", SECOND_ORDER),
        _defined("height", "Sp", "highest point above the mean", r"\max z", "m", "4.2", SECOND_ORDER),
        _defined("height", "Sv", "deepest point below the mean", r"-\min z", "m", "4.2", SECOND_ORDER),
        _defined("height", "Sz", "from the lowest point to the highest", "S_p + S_v", "m", "4.2", SECOND_ORDER),
        _defined("height", "St", "the same as Sz", "S_z", "m", SOURCE, SECOND_ORDER),
        _defined(
            "height", "Ssk", "skewness: below 0 for valleys", r"\langle z^3 \rangle / S_q^3", "1", "4.2", SECOND_ORDER
        ),
        _defined(
            "height",
            "Sku",
            "kurtosis: 3 for Gaussian heights",
            r"\langle z^4 \rangle / S_q^4",
            "1",
            "4.2",
            SECOND_ORDER,
        ),
        _defined(
            "functional",
            "Sk",
            "core: line in the flattest 40 %",
            r"a(0) - a(1),\; a \text{ fitted to } S_{mc} \text{ over the flattest } 40\,\%",
            "m",
            "4.5",
            CURVE,
        ),
        _defined(
            "functional",
            "Spk",
            "peaks above the core",
            r"\frac{2}{S_{mr1}} \int_0^{S_{mr1}} (S_{mc}(r) - a(0))\, dr",
            "m",
            "4.5",
            CURVE,
        ),
        _defined(
            "functional",
            "Svk",
            "valleys below the core",
            r"\frac{2}{1 - S_{mr2}} \int_{S_{mr2}}^1 (a(1) - S_{mc}(r))\, dr",
            "m",
            "4.5",
            CURVE,
        ),
        _defined("functional", "Smr1", "material ratio above the core", r"S_{mc}(S_{mr1}) = a(0)", "1", "4.5", CURVE),
        _defined(
            "functional", "Smr2", "material ratio above the valleys", r"S_{mc}(S_{mr2}) = a(1)", "1", "4.5", CURVE
        ),
        _defined(
            "functional",
            "Sxp",
            "from the median to the top 2.5 %",
            r"S_{mc}(2.5\,\%) - S_{mc}(50\,\%)",
            "m",
            "4.5",
            CURVE,
        ),
        _defined(
            "volume",
            "Vmp",
            "material of the peaks, top 10 %",
            r"V_m(10\,\%),\; V_m(p) = \int_0^p (S_{mc}(r) - S_{mc}(p))\, dr",
            "m",
            "4.5",
            CURVE,
        ),
        _defined("volume", "Vmc", "material of the core, 10 to 80 %", r"V_m(80\,\%) - V_m(10\,\%)", "m", "4.5", CURVE),
        _defined("volume", "Vvc", "void of the core, 10 to 80 %", r"V_v(10\,\%) - V_v(80\,\%)", "m", "4.5", CURVE),
        _defined(
            "volume",
            "Vvv",
            "void of the valleys, below 80 %",
            r"V_v(80\,\%),\; V_v(p) = \int_p^1 (S_{mc}(p) - S_{mc}(r))\, dr",
            "m",
            "4.5",
            CURVE,
        ),
        _defined(
            "hybrid",
            "Sdq",
            "root mean square gradient",
            r"\sqrt{\langle (\partial_x z)^2 + (\partial_y z)^2 \rangle}",
            "1",
            "4.4",
            SECOND_ORDER,
        ),
        _defined(
            "hybrid",
            "Sdr",
            "developed area over projected, less 1",
            r"\langle \sqrt{1 + (\partial_x z)^2 + (\partial_y z)^2} \rangle - 1",
            "1",
            "4.4",
            SECOND_ORDER,
        ),
        _defined(
            "spatial",
            "Sal",
            "shortest correlation length",
            r"\min |t|,\; \langle z(x) z(x + t) \rangle = 0.2\, S_q^2",
            "m",
            "4.3",
            "10⁻³, 10⁻⁴, 10⁻⁵ at 4, 8, 16 pixels per correlation length",
        ),
        _defined(
            "spatial",
            "Str",
            "shortest over longest: 0 for a lay",
            r"S_{al} / \max |t|,\; \langle z(x) z(x + t) \rangle = 0.2\, S_q^2",
            "1",
            "4.3",
            "as Sal",
        ),
        _defined(
            "spatial",
            "Std",
            "direction of the ridges from x",
            r"90^\circ + \theta,\; \int |\hat z(q, \theta)|^2 q\, dq \text{ greatest}",
            "deg",
            "4.3",
            "0.1° with a dozen grooves in view",
        ),
        _defined(
            "feature",
            "Spd",
            "density of significant peaks",
            r"N_\text{peaks} / A",
            "1/m^2",
            "5.8",
            "none once each hill is resolved",
        ),
        _defined(
            "feature",
            "Spc",
            "mean curvature at these peaks",
            r"-\tfrac{1}{2} \langle \partial_x^2 z + \partial_y^2 z \rangle_\text{peaks}",
            "1/m",
            "5.8",
            "second order for symmetric peaks, else first",
        ),
        _defined(
            "feature",
            "S5p",
            "mean height of the five highest",
            r"\tfrac{1}{5} \sum_{i=1}^5 z_{\text{peak},i}",
            "m",
            "5.8",
            SECOND_ORDER,
        ),
        _defined(
            "feature",
            "S5v",
            "mean depth of the five deepest pits",
            r"-\tfrac{1}{5} \sum_{i=1}^5 z_{\text{pit},i}",
            "m",
            "5.8",
            SECOND_ORDER,
        ),
        _defined("feature", "S10z", "ten-point height, also named S5z", r"S_{5p} + S_{5v}", "m", "5.8", SECOND_ORDER),
        _defined(
            "feature",
            "Spm",
            "mean of five peaks, Sal apart",
            r"\tfrac{1}{5} \sum_{i=1}^5 z_i,\; \text{no two within } S_{al}",
            "m",
            SOURCE,
            SECOND_ORDER,
        ),
        _defined(
            "feature",
            "Svm",
            "mean of five valleys, Sal apart",
            r"-\tfrac{1}{5} \sum_{i=1}^5 z_i,\; \text{no two within } S_{al}",
            "m",
            SOURCE,
            SECOND_ORDER,
        ),
    )
)
"""Areal parameters by their names, in the order of the tables; z is measured from the mean of the valid points."""


PROFILE_STANDARD = "ISO 21920-2:2021"
SECTION_MEAN = r"\tfrac{1}{5} \sum_{i=1}^5 "


def _like_areal(name: str) -> tuple[str, Definition]:
    """The definition of a profile parameter that is that of the areal one for the heights of a profile."""
    areal = AREAL[f"S{name[1:]}"]
    return name, replace(areal, name=name, equation=areal.equation.replace("S_", "R_"), standard=PROFILE_STANDARD)


def _profile(group: Group, name: str, meaning: str, equation: str, unit: str, accuracy: str) -> tuple[str, Definition]:
    return _defined(group, name, meaning, equation, unit, PROFILE_STANDARD, accuracy)


PROFILE: Mapping[str, Definition] = dict(
    (
        _like_areal("Ra"),
        _like_areal("Rq"),
        _profile("height", "Rt", "from the lowest point to the highest", r"\max z - \min z", "m", SECOND_ORDER),
        _profile(
            "height", "Rp", "highest point, mean of five sections", SECTION_MEAN + r"\max_{l_i} z", "m", SECOND_ORDER
        ),
        _profile(
            "height",
            "Rv",
            "deepest point, mean of five sections",
            "-" + SECTION_MEAN + r"\min_{l_i} z",
            "m",
            SECOND_ORDER,
        ),
        _profile("height", "Rz", "maximum height, mean of five sections", "R_p + R_v", "m", SECOND_ORDER),
        *map(_like_areal, ("Rsk", "Rku", "Rk", "Rpk", "Rvk", "Rmr1", "Rmr2")),
        _profile("hybrid", "Rdq", "root mean square gradient", r"\sqrt{\langle (dz/dx)^2 \rangle}", "1", SECOND_ORDER),
        _profile("feature", "Rsm", "mean spacing of profile elements", r"\langle X_s \rangle", "m", SECOND_ORDER),
        _profile("feature", "Rc", "mean height of profile elements", r"\langle Z_t \rangle", "m", SECOND_ORDER),
    )
)
"""Profile parameters by their names, in the order of the tables; z is measured from the mean of the profile."""
