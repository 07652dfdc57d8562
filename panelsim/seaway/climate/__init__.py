"""What seas occur: sea states, scatter tables, limits of steepness."""
