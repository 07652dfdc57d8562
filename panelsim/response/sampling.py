"""How far the variance of one run may lie from that of its sea: the sampling error.

A run in N waves is x = Σ c_i cos(ω_i t + ε_i), its measured variance v = (1/T) ∫ x² dt over T seconds. With
phases that are independent and uniform the mean of v is Σ m_i, m_i = ½ c_i², whatever T, and the pairs of
waves that T does not tell apart scatter it: with s(x) = sin x/x,

    Var v = 2 Σ_{i<j} m_i m_j [s²((ω_i - ω_j) T/2) + s²((ω_i + ω_j) T/2)] + ½ Σ_i m_i² s²(ω_i T).

For many waves close together this is (2π/T) ∫ S² dω, which Bendat and Piersol, Random Data (2010), section
8.2, have for a Gaussian process.
"""

import numpy as np

from panelsim.conventions import FloatArray


def variance_scatter(frequency: FloatArray, variance: FloatArray, duration: float) -> FloatArray:
    """Variance over random phases (S,) of the variances that runs of `duration` [s] show of S signals.

    `frequency` (N,) [rad/s] of the waves as the ship meets them, signed or not; `variance` (N, S) of each
    signal in each wave. The runs have their means left in: in the sums of waves they are 0.
    """
    apart, together = (
        np.sinc(0.5 * duration / np.pi * (frequency[:, None] + sign * frequency)) ** 2 for sign in (-1.0, 1.0)
    )
    pairs = np.einsum("is,ij,js->s", variance, apart + together, variance)
    # A wave does not beat with itself: its amplitude is not left to chance.
    alone = variance**2 * (1.0 + 0.5 * np.diag(together))[:, None]
    return np.asarray(pairs - alone.sum(axis=0))
