"""Fields of OpenFOAM are read as it writes them: in lines or in one line, and damaged ones are refused."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.fields import internal_field

HEADER = "FoamFile\n{\n    format      ascii;\n    class       volVectorField;\n}\n"
BOUNDARY = (
    "boundaryField\n{\n    wall\n    {\n        value           nonuniform List<vector> 2((9 9 9) (9 9 9));\n    }\n}\n"
)


def written(path, kind, values):
    path.write_text(f"{HEADER}internalField   nonuniform List<{kind}> {values};\n{BOUNDARY}")
    return path


@pytest.mark.parametrize("cells", [None, 2])
@pytest.mark.parametrize("values", ["2((1 2 3) (4 5 6))", "\n2\n(\n(1 2 3)\n(4 5 6)\n)\n"], ids=["one line", "lines"])
def test_a_field_of_few_cells_is_read(tmp_path, values, cells):
    assert np.array_equal(internal_field(written(tmp_path / "U", "vector", values), 3, cells), [[1, 2, 3], [4, 5, 6]])


@pytest.mark.parametrize("values", ["3(1 2.5 -3e-2)", "\n3\n(\n1\n2.5\n-3e-2\n)\n"], ids=["one line", "lines"])
def test_a_scalar_of_few_cells_is_read(tmp_path, values):
    assert np.array_equal(internal_field(written(tmp_path / "p", "scalar", values), 1), [[1], [2.5], [-0.03]])


@pytest.mark.parametrize("values", ["2((1 2 3))", "2((1 2 3) (4 5 6) (7 8 9))", "2((1 2 3) (4 x 6))"])
def test_a_field_with_other_values_than_it_claims_is_refused(tmp_path, values):
    with pytest.raises(InputError, match="values, of which some are no numbers, or not 6; run the case again"):
        internal_field(written(tmp_path / "U", "vector", values), 3)
