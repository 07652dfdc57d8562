"""panelsim: a nonlinear panel-method, time-domain ship-motion solver."""

__version__ = "0.1.0"
