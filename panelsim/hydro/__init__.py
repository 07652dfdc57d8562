"""Hydrodynamic coefficients of a ship: database, boundary elements, memory functions."""
