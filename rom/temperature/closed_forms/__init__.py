"""Exact solutions of films with temperature and of solids under friction heat, the references of numerical ones."""
