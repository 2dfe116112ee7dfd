"""The dictionary of snappyHexMesh, without text from a scene."""

from typing import Any

from roughfilm.foamcases.openfoam.dictionaries import Dictionary
from roughfilm.foamcases.rough_gap.dictionaries import CONTACT

SURFACE = "solid.stl"
"""Name of the file of the solid in ``constant/triSurface``."""

MAX_CELLS = 20_000_000
"""Number of cells at which snappyHexMesh stops refining."""

MAX_SKEWNESS = 3.9
"""Largest skewness of a face after snapping; the mesh check allows 4."""

NO_LAYERS: dict[str, Any] = {
    "relativeSizes": True,
    "expansionRatio": 1.0,
    "finalLayerThickness": 0.3,
    "minThickness": 0.1,
    "featureAngle": 60,
    "nGrow": 0,
    "maxFaceThicknessRatio": 0.5,
    "nBufferCellsNoExtrude": 0,
    "nLayerIter": 1,
    "layers": {},
}
"""Settings of boundary layers, which openfoam.org 7 to 9 read although no layers are added."""


def snappy_dictionary(inside: tuple[float, float, float], level: int) -> Dictionary:
    """The dictionary ``system/snappyHexMeshDict``: remove cells without liquid, and move faces to the solid.

    The faces of the solid become the patch ``CONTACT``. No boundary layers are added.

    Parameters
    ----------
    inside : a point in the liquid, in the unit of the mesh.
    level : how many times cells at the solid are halved.
    """
    name = CONTACT.name
    return (
        "dictionary",
        {
            "castellatedMesh": True,
            "snap": True,
            "addLayers": False,
            "mergeTolerance": 1e-6,
            "geometry": {name: {"type": "triSurfaceMesh", "file": f'"{SURFACE}"'}},
            "castellatedMeshControls": {
                "maxLocalCells": MAX_CELLS,
                "maxGlobalCells": MAX_CELLS,
                "minRefinementCells": 0,
                "nCellsBetweenLevels": 2,
                "features": [],
                "refinementSurfaces": {name: {"level": [level, level], "patchInfo": {"type": "wall"}}},
                "refinementRegions": {},
                "resolveFeatureAngle": 30,
                "locationInMesh": list(inside),
                "allowFreeStandingZoneFaces": False,
            },
            "snapControls": {
                "nSmoothPatch": 3,
                "tolerance": 2.0,
                "nSolveIter": 30,
                "nRelaxIter": 5,
                "nFeatureSnapIter": 10,
                "implicitFeatureSnap": True,
                "explicitFeatureSnap": False,
                "multiRegionFeatureSnap": False,
            },
            "addLayersControls": NO_LAYERS,
            "meshQualityControls": {
                "maxNonOrtho": 65,
                "maxBoundarySkewness": MAX_SKEWNESS,
                "maxInternalSkewness": MAX_SKEWNESS,
                "maxConcave": 80,
                "minVol": 1e-13,
                "minTetQuality": 1e-15,
                "minArea": -1,
                "minTwist": 0.02,
                "minDeterminant": 0.001,
                "minFaceWeight": 0.05,
                "minVolRatio": 0.01,
                "minTriangleTwist": -1,
                "nSmoothScale": 4,
                "errorReduction": 0.75,
                "relaxed": {"maxNonOrtho": 75},
            },
        },
    )
