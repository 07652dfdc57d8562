"""The wheel carries the reference ships and works from any folder."""

import json
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

import panelsim

ROOT = Path(__file__).parents[1]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built by the tools that are installed."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", folder, ROOT]
    built = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    assert built.returncode == 0, built.stdout + built.stderr
    (path,) = folder.glob("panelsim-*.whl")
    return path


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The `panelsim` of a new virtual environment that borrows the dependencies of this one."""
    folder = tmp_path_factory.mktemp("venv")
    venv.create(folder, with_pip=True)
    python = folder / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "--no-deps", "--quiet", "--no-index", wheel], check=True)
    own = Path(
        subprocess.run(
            [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.strip()
    )
    # A folder named in a .pth comes after the environment's own, whose panelsim is therefore the one found.
    (own / "borrowed.pth").write_text(f"{sysconfig.get_path('purelib')}\n{sysconfig.get_path('platlib')}\n")
    return folder / "bin" / "panelsim"


def test_every_file_of_the_hulls_is_in_the_wheel(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    hulls = ROOT / "hulls"
    files = {f"panelsim/bundled_hulls/{p.relative_to(hulls)}" for p in hulls.rglob("*") if p.is_file()}
    assert "panelsim/bundled_hulls/halifax/hydro.nc" in files
    assert files <= names
    assert not any(name.startswith(("tests/", "hulls/", "benchmarks/")) for name in names)


def test_the_installed_command_finds_its_ships_from_another_folder(installed: Path, tmp_path: Path) -> None:
    def panelsim_of_the_wheel(*arguments: str) -> str:
        return subprocess.run(
            [installed, *arguments], capture_output=True, text=True, check=True, cwd=tmp_path
        ).stdout

    assert panelsim_of_the_wheel("--version") == f"panelsim {panelsim.__version__}\n"
    facts = json.loads(panelsim_of_the_wheel("hull", "halifax", "--json"))
    # The displacement of TM 2003-190 Table 2 within 1 %: the lines are those of another frigate.
    assert facts["mass"] == pytest.approx(4655e3, rel=0.01)


def test_the_installed_package_is_not_the_checkout(installed: Path, tmp_path: Path) -> None:
    home = subprocess.run(
        [installed.parent / "python", "-c", "import panelsim; print(panelsim.__file__)"],
        capture_output=True,
        text=True,
        check=True,
        cwd=tmp_path,
    ).stdout
    assert Path(home).is_relative_to(installed.parents[1])
