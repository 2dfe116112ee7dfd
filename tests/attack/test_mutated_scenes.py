"""A sample of mutated scenes: each has a finite answer or an error that a person can read."""

import pytest
from attack.mutated_scenes import answered
from attack.mutations import mutated

SAMPLE = range(9000, 9060)


def test_a_seed_always_makes_the_same_file():
    assert [mutated(seed) for seed in SAMPLE] == [mutated(seed) for seed in SAMPLE]


@pytest.mark.parametrize("first", SAMPLE[::30])
def test_mutated_scenes_have_sound_answers(first, tmp_path):
    answers = [answered(seed, tmp_path) for seed in range(first, first + 30)]
    assert not [answer for answer in answers if answer.outcome == "fault"]
