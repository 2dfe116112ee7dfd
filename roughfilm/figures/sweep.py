"""The plots of a sweep: errors against the number that orders them, errors against cost."""

from collections.abc import Mapping, Sequence

import numpy as np

from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.view import views
from roughfilm.rom.studies.ordering import Ordering, product
from roughfilm.rom.studies.reference import Reference, interval
from roughfilm.rom.studies.sweep import Sweep, kind_of_sweep, loaded, relative_error, sweeping

MIN_PERCENT = 1e-3


def errors_in_order(
    sweep: Sweep, reference: Reference, orderings: Mapping[tuple[str, str], Ordering], settings: Sequence[str]
) -> str:
    """Error against the number that orders it, a panel for each setting and quantity, with the thresholds.

    Errors below the uncertainty of the reference have hollow marks.
    """
    kind, groups = kind_of_sweep(sweep), views()[sweep.kind].groups(sweep.given)
    named = set[str]()
    pairs = [
        (setting, quantity) for setting in settings for quantity in kind.compared if (setting, quantity) in orderings
    ]
    lines = -(-len(pairs) // 2)
    figure, panels = new_figure((10, 0.6 + 2.6 * lines), lines, 2, squeeze=False)
    for axes in panels.flat[len(pairs) :]:
        axes.set_axis_off()
    for axes, (setting, quantity) in zip(panels.flat, pairs, strict=False):
        law = orderings[setting, quantity]
        with np.errstate(divide="ignore", invalid="ignore"):
            number = product(sweep.features(), law.powers)
        error = 100 * relative_error(sweep, setting, reference.setting, quantity)
        error[~loaded(sweep, reference.setting)] = np.nan
        certain = interval(sweep, setting, reference, quantity)[0] > 0
        for place, ((group, rows), sign) in enumerate(zip(groups.items(), "osD^v<>", strict=False)):
            label = None if group in named else group
            named.add(group)
            line_of, colour = {"linestyle": "none", "marker": sign, "ms": 3, "alpha": 0.6}, f"C{place}"
            for chosen, face, name in ((rows & certain, colour, label), (rows & ~certain, "none", None)):
                drawn = np.maximum(error[chosen], MIN_PERCENT)
                axes.plot(number[chosen], drawn, color=colour, mfc=face, label=name, **line_of)
        for tolerance, limit in law.thresholds.items():
            if limit is not None:
                axes.plot([np.nanmin(number), limit, limit], [100 * tolerance] * 2 + [MIN_PERCENT], "k:", lw=0.8)
        axes.set(xscale="log", yscale="log")
        axes.set_title(f"{setting}: {kind.compared[quantity]}, rank correlation {law.rank:.3f}", fontsize=9)
        axes.set_xlabel(sweeping(kind).words(law.powers), fontsize=8)
        axes.tick_params(axis="x", which="both", labelsize=7)
        axes.set_ylabel("error, %", fontsize=8)
    figure.legend(loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)


def sweep_chart(sweep: Sweep, reference: Reference, settings: Sequence[str]) -> str:
    """CPU seconds against error over all cases: a dot each, the median, and a bar up to 95 of 100 cases.

    The grey band ends at the median uncertainty of the reference.
    """
    kind, view = kind_of_sweep(sweep), views()[sweep.kind]
    figure, panels = new_figure((10, 4.6), 1, len(kind.compared))
    for axes, (quantity, title) in zip(panels, kind.compared.items(), strict=True):
        for setting in settings:
            error = np.maximum(100 * relative_error(sweep, setting, reference.setting, quantity), MIN_PERCENT)
            time = sweep.cpu_s[setting]
            known = np.isfinite(error) & np.isfinite(time) & loaded(sweep, reference.setting)
            if not known.any():
                continue
            middle, high = np.percentile(error[known], [50, 95])
            axes.plot(time[known], error[known], ".", color=view.style_of(setting).colour, ms=2, alpha=0.25)
            axes.errorbar(
                np.median(time[known]),
                middle,
                [[0], [high - middle]],
                fmt=view.style_of(setting).marker,
                color=view.style_of(setting).colour,
                capsize=4,
                label=setting,
            )
        bar = reference.uncertainty[quantity][loaded(sweep, reference.setting)]
        if np.isfinite(bar).any():
            axes.axhspan(MIN_PERCENT, max(100 * np.nanmedian(bar), MIN_PERCENT), color="black", alpha=0.06, zorder=-1)
        axes.axvline(
            np.nanmedian(sweep.cpu_s[reference.setting]),
            color=view.style_of(reference.setting).colour,
            ls=":",
            label=f"{reference.setting} (reference)",
        )
        axes.set(xscale="log", yscale="log", xlabel="CPU time a case, s", ylabel=f"error in {title}, %")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)
