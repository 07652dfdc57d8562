"""Point spectra S(ω): how the energy of a sea is spread over the frequencies."""
