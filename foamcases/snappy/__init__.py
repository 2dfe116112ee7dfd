"""OpenFOAM cases of rough gaps whose meshes snappyHexMesh makes."""
