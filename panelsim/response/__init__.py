"""The linear ship in the frequency domain: transfer functions, and what they make of a sea."""
