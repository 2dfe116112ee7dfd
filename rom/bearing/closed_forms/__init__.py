"""Closed-form solutions of films: sliding pads, journals, walls that approach each other, hydrostatic pads."""
