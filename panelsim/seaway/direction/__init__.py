"""Directional spectra S(ω, ν): how the energy of a sea is spread over the directions too."""
