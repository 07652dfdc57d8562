"""Two-dimensional hydrodynamics of a ship's sections, the material of strip theory."""
