"""Files are whole or not there, on a full disk too."""

import errno
from pathlib import Path

import pytest

from panelsim.errors import PanelsimError
from panelsim.files import replacing, write_whole


@pytest.fixture
def full_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every write of bytes leaves a half and then finds no room."""
    plain = Path.write_bytes

    def write_half(self: Path, data: bytes) -> int:
        plain(self, bytes(data)[: len(data) // 2])
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", write_half)


def test_a_file_is_replaced_whole(tmp_path: Path) -> None:
    write_whole(tmp_path / "new folder" / "a.bin", b"one")
    write_whole(tmp_path / "new folder" / "a.bin", b"two")
    assert (tmp_path / "new folder" / "a.bin").read_bytes() == b"two"


@pytest.mark.usefixtures("full_disk")
def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    (tmp_path / "a.bin").write_text("old")
    with pytest.raises(PanelsimError, match="cannot be written") as refusal:
        write_whole(tmp_path / "a.bin", b"new and longer")
    assert "No space left" in str(refusal.value) and "a.bin" in str(refusal.value)
    assert [path.name for path in tmp_path.iterdir()] == ["a.bin"]
    assert (tmp_path / "a.bin").read_text() == "old"


def test_a_place_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(PanelsimError, match="cannot be written"), replacing(tmp_path / "file" / "a.bin"):
        pass
