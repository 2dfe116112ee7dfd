"""Reduced-order models: the nouns (scene, gap, result), film flow in closed form, and the ladder of models."""
