"""A sample of damaged and forged files: each is refused in one line or read without fault, within limits."""

from attack.damaged_files import answers
from attack.good_files import KINDS

SAMPLE = range(9000, 9000 + 2 * len(KINDS))


def test_damaged_files_are_refused_in_one_line_or_read():
    found = [*answers(SAMPLE)]
    assert len(found) == len(SAMPLE)
    assert not [answer for answer in found if answer.outcome == "fault"]
    assert sum(answer.outcome == "refused" for answer in found) > len(SAMPLE) / 2
