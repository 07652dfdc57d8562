"""What a response was made from, as attributes of its file."""

import json
from collections.abc import Sequence
from importlib.metadata import version

from panelsim.conventions import FloatArray
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.roll_damping import describe_terms
from panelsim.response.linear_ship import LinearShip


def made_from(
    linear_ship: LinearShip, speeds: FloatArray, roll_damping: Sequence[RollDampingTerms]
) -> dict[str, str | float]:
    """Ship, coefficients, supplementary terms, roll damping, transom terms and version.

    `speeds` (S,) [m/s]; `roll_damping` at each of them. Draft in m, mass in kg; supplementary terms as JSON.
    """
    ship, supplementary = linear_ship.ship, linear_ship.supplementary
    return {
        "panelsim_version": version("panelsim"),
        "ship": ship.name,
        "draft": float(ship.draft),
        "mass": float(ship.mass),
        "units": "SI and radians: draft in m, mass in kg, speeds in m/s",
        "coefficients": str(linear_ship.database.dataset.attrs.get("solver", "not recorded")),
        "supplementary": json.dumps(
            {"stiffness": dict(supplementary.stiffness), "damping": dict(supplementary.damping)}
        ),
        "roll_damping": _by_speed(speeds, roll_damping),
        "transom_terms": "no" if linear_ship.transom is None else "yes",
    }


def _by_speed(speeds: FloatArray, roll_damping: Sequence[RollDampingTerms]) -> str:
    """The terms in words: once where they are those of every speed."""
    if not any(terms.linear or terms.quadratic or terms.cubic for terms in roll_damping):
        return "none"
    words = [describe_terms(terms) for terms in roll_damping]
    if len(set(words)) == 1:
        return words[0]
    return "; ".join(f"at {speed:.4g} m/s {each}" for speed, each in zip(speeds, words, strict=True))
