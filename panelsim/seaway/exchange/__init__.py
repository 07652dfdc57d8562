"""Seas from elsewhere and to elsewhere: components, measured elevations, spectra of buoys and wave models."""
