"""Roughness averaged: what a periodic gap lets through, drags along and rubs, as factors of a smooth film."""
