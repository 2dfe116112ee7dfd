"""The roughness parameters as a page in Markdown, from their definitions."""

from collections.abc import Iterator, Mapping

from roughfilm.contact.parameters.definitions import AREAL, GROUPS, PROFILE, Definition

INTRODUCTION = """\
`roughfilm surface` and `rf.parameters` give the areal parameters of ISO 25178-2, `rf.profile_parameters` those of one
profile. $\\langle\\cdot\\rangle$ is the mean over the valid points, $z$ the height from it. No parameter filters or
levels: that is done before, by the [recipe](../../theory/surfaces.md#preparation). **Values without their nesting
indices are not comparable between laboratories**: name those of the S-filter, the L-filter and the form with each
value; the terminal and the page of a surface do. [Surfaces](../../theory/surfaces.md#parameters) has the rules of
segmentation, edges and invalid points."""

FIELDS = """\
$S_{mc}(p)$ is the height above which the fraction $p$ of the points lies, and $a$ the line through the flattest 40 % of
this curve. Volumes are per area, in m³/m²; 1 µm is 1 ml/m². Std is the direction along the ridges, 90° from the angle
of the standard. A parameter is left out where a surface does not have it: Spc, S5p, S5v and S10z where no hill or dale
lies inside the edges.

*Error* is the order of the discretisation error in the spacing of the points, or in 1/n for a smooth bearing curve of n
different heights. Means over a smooth periodic surface are better than second order."""

PROFILES = """\
The names of a primary profile begin with P, those of a waviness profile with W (`profile="P"`). Rp, Rv and Rz are means
over five section lengths $l_i$ (`sections`); all others belong to the whole evaluation length, as in ISO 21920-2.
$X_s$ and $Z_t$ are length and height of a profile element, a hill and the dale beside it, in both orders; a hill counts
if it is higher than 10 % of Rp, a dale if it is deeper than 10 % of Rv. Rmr(c), Rmc(p) and Rdc(p, q) need a height or
ratios of your choice: `roughfilm.contact.parameters.bearing_curve.material_ratio` and
`roughfilm.contact.parameters.bearing_curve.height_at_ratio`."""


def page() -> str:
    """The page of all roughness parameters in Markdown.

    Examples
    --------
    >>> "| Sdq |" in page(), "| Rsm |" in page()
    (True, True)
    """
    lines = ["# Roughness parameters", "", INTRODUCTION, "", "## Areal parameters", "", FIELDS, "", *_tables(AREAL)]
    return "\n".join([*lines, "## Profile parameters", "", PROFILES, "", *_tables(PROFILE)])


def _tables(definitions: Mapping[str, Definition]) -> Iterator[str]:
    for group, heading in GROUPS.items():
        rows = [one for one in definitions.values() if one.group == group]
        if rows:
            yield from (f"### {heading[0].upper()}{heading[1:]}", "")
            yield from ("| name | meaning | definition | unit | source | error |", "|---|---|---|---|---|---|")
            yield from map(_row, rows)
            yield ""


def _row(one: Definition) -> str:
    equation = one.equation.replace("|", r"\vert ")
    unit = one.unit.replace("^2", "²") if one.group != "volume" else "m³/m²"
    return f"| {one.name} | {one.meaning} | ${equation}$ | {unit} | {one.standard} | {one.accuracy} |"
