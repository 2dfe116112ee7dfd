"""The mesh of a cell in plan: hexahedra in columns that meet both walls at right angles."""
