"""Compiled loops over panels and wave components: arrays in, arrays out. The only importer of Taichi."""
