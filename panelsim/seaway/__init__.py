"""Wave spectra, random and regular seaways, and the pressure and elevation of their waves."""
