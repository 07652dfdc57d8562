"""A hull with its loading, afloat in equilibrium."""
