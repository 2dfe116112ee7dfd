"""OpenFOAM cases of a study that a person or a cluster runs: their files, and the results that are collected."""
