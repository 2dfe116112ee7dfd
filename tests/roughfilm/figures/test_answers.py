"""Figures of the answers of a sweep."""

import numpy as np

from roughfilm.figures import answers
from roughfilm.figures.view import views
from roughfilm.rom.studies.answers import Answer, Sense
from roughfilm.rom.studies.parameters import Parameter
from roughfilm.words.scales import Scale


def test_the_shared_axis_of_panels_shows_the_values_of_all(monkeypatch):
    figures = []
    monkeypatch.setattr(answers, "svg", lambda figure: figures.append(figure) or "")
    depth, width = np.tile([5.0, 10.0, 20.0], 2), np.repeat([0.2, 0.4], 3)
    parameters = [Parameter(name="width", values=width, unit="mm"), Parameter(name="depth", values=depth, unit="µm")]
    load = 10.0 * depth * width  # less than 1.5 decades, so that the axis is linear
    answer = Answer(
        quantity="load_plus",
        setting="film",
        sense=Sense.LARGEST,
        values=load,
        uncertainty=np.full(6, np.nan),
        by_laws=np.zeros(6, dtype=bool),
        order=tuple(map(int, np.argsort(-load))),
    )
    answers.over_parameters(parameters, [answer], "load", Scale(factor=1.0, unit=""), views()["pocket"])
    low, high = figures[0].axes[1].get_ylim()
    assert low <= load.min()
    assert high >= load.max()
