"""HDF5 files of numbers, read by name with words for what is not there."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError


class Hdf5Numbers:
    """An open HDF5 file; every read raises PanelsimError, with the name, where there is nothing to read."""

    def __init__(self, path: Path, file: Any) -> None:
        self.path = path
        self._file = file

    def __contains__(self, name: str) -> bool:
        return name in self._file

    def array(self, name: str) -> FloatArray:
        """A dataset as floating-point numbers of its own shape."""
        try:
            return np.asarray(self._dataset(name)[()], dtype=np.float64)
        except (OSError, ValueError, TypeError) as error:
            raise PanelsimError(f"{name} cannot be read as numbers", got=f"{self.path} ({error})") from error

    def vector(self, name: str) -> FloatArray:
        """A dataset as numbers in a row (N,); MATLAB writes rows and columns."""
        return self.array(name).ravel()

    def number(self, name: str) -> float:
        """A dataset of one number."""
        values = self.vector(name)
        if values.size != 1:
            raise PanelsimError(f"{name} is not one number", got=f"{self.path}: {values.size} of them")
        return float(values[0])

    def text(self, name: str) -> str | None:
        """A dataset of one text, None where it holds numbers."""
        value = self._dataset(name)[()]
        value = value.ravel()[0] if isinstance(value, np.ndarray) and value.size else value
        if isinstance(value, bytes):
            return value.decode(errors="replace").strip("\x00 ")
        return value if isinstance(value, str) else None

    def attribute(self, name: str, attribute: str) -> str | None:
        """A text beside a dataset, None where there is none."""
        value = self._dataset(name).attrs.get(attribute)
        if isinstance(value, bytes):
            return value.decode(errors="replace")
        return None if value is None else str(value)

    def _dataset(self, name: str) -> Any:
        found = self._file.get(name)
        if not isinstance(found, h5py.Dataset):
            raise PanelsimError("The file is not whole", got=f"{self.path} without {name}")
        return found


@contextmanager
def opened(path: Path, kind: str) -> Iterator[Hdf5Numbers]:
    """An HDF5 file of this kind; raises PanelsimError where it is missing, damaged or cut short."""
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise PanelsimError(
            f"The {kind} file cannot be read: it is missing, damaged, cut short or not HDF5",
            got=f"{path} ({str(error).splitlines()[0][:200]})",
        ) from error
    with file:
        yield Hdf5Numbers(path, file)
