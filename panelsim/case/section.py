"""What every table of a case file is, and the numbers that it may hold."""

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, field_validator

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Place = Annotated[list[Finite], Field(min_length=3, max_length=3)]  # m, in hull axes
Degrees = Annotated[float, Field(ge=-360, le=360)]


class KeyFault(ValueError):
    """Keys of a table that do not go together, told with the parts of a PanelsimError."""

    def __init__(self, what: str, *, got: str, allowed: str, remedy: str) -> None:
        super().__init__(what)
        self.got, self.allowed, self.remedy = got, allowed, remedy


class Section(BaseModel):
    """A table of the case file: no key that it does not know, no text where a number belongs."""

    model_config = ConfigDict(extra="forbid", strict=True)

    @field_validator("*", mode="before")
    @classmethod
    def _no_null(cls, value: Any) -> Any:
        """No name of a file, or of anything, holds the null character."""
        if isinstance(value, str) and "\0" in value:
            raise ValueError("the text holds the character \\u0000")
        return value
