"""Hydrodynamic databases of other programs: Capytaine, WAMIT, BEMIO and HDB5; one module a format."""
