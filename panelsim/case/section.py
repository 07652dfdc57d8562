"""What every table of a case file is, and the numbers that it may hold."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Degrees = Annotated[float, Field(ge=-360, le=360)]


class Section(BaseModel):
    """A table of the case file: no key that it does not know, no text where a number belongs."""

    model_config = ConfigDict(extra="forbid", strict=True)
