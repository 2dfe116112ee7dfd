"""What the command batch says at its end."""

from types import SimpleNamespace

import pytest

from roughfilm.batch.progress import BatchProgress
from roughfilm.cli.many_cases.batch import _show_outcome


@pytest.mark.parametrize(("count", "words"), [(1, "warning: 1 result has warnings;"), (2, "2 results have warnings;")])
def test_results_with_warnings_are_counted(count, words, tmp_path, capsys):
    _show_outcome(SimpleNamespace(), BatchProgress(warned=count), tmp_path, as_json=False)
    assert words in capsys.readouterr().err
