"""The wheel, installed where there is no checkout, with a plug-in beside it.

Takes a minute and needs the package index: `pytest -m packaging` runs it alone,
`pytest -m "not packaging"` all the rest.
"""

import os
import shutil
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

import swarmdsl

ROOT = Path(__file__).resolve().parents[1]

pytestmark = [pytest.mark.long, pytest.mark.packaging, pytest.mark.timeout(900)]


def run(*command: object, cwd: Path) -> "subprocess.CompletedProcess[str]":
    # Nothing of the checkout may leak into what is tested.
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return subprocess.run(
        [str(word) for word in command], cwd=cwd, env=environment, capture_output=True, text=True
    )


def run_ok(*command: object, cwd: Path) -> str:
    ran = run(*command, cwd=cwd)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout + ran.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("packaging")


@pytest.fixture(scope="module")
def python(folder: Path) -> Path:
    """A fresh environment, and proof that there is a package index to fill it from."""
    venv.create(folder / "venv", with_pip=True)
    python = folder / "venv" / ("Scripts" if os.name == "nt" else "bin") / "python"
    pip = (python, "-m", "pip", "--disable-pip-version-check")
    probe = run(*pip, "download", "--no-deps", "-d", folder / "probe", "hatchling", cwd=folder)
    if probe.returncode != 0:
        pytest.skip(f"no package index: {probe.stderr.strip().splitlines()[-1]}")
    return python


@pytest.fixture(scope="module")
def wheel(folder: Path, python: Path) -> Path:
    """The wheel of `make dist`, made from the source distribution as it is for a release."""
    made = os.environ.get("SWARMDSL_DIST")
    dist = Path(made) if made else folder / "dist"
    if made is None:
        run_ok(sys.executable, "-m", "build", "--outdir", dist, ROOT, cwd=folder)
    (wheel,) = dist.glob(f"*-{swarmdsl.__version__}-*.whl")
    return wheel


@pytest.fixture(scope="module")
def installed(folder: Path, python: Path, wheel: Path) -> Path:
    """The folder of the installed commands."""
    plugins = [
        shutil.copytree(ROOT / "tests" / "plugins" / name, folder / name)
        for name in ("roster", "warehouse")
    ]
    run_ok(python, "-m", "pip", "install", "--quiet", wheel, *plugins, cwd=folder)
    shutil.copytree(ROOT / "examples", folder / "examples")
    return python.parent


def test_the_wheel_has_every_file_of_the_package(wheel):
    with zipfile.ZipFile(wheel) as archive:
        packed = set(archive.namelist())
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "src/swarmdsl", "grammar", "generators"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    if listed.returncode != 0:
        pytest.skip("not a git checkout: nothing says which files there ought to be")
    expected = {
        path.removeprefix("src/").replace("generators/", "swarmdsl/codegen/bundled/", 1)
        if path.startswith(("src/", "generators/"))
        else f"swarmdsl/{path}"
        for path in listed.stdout.splitlines()
    }
    assert "swarmdsl/grammar/swarm.tx" in expected
    assert expected - packed == set()
    assert any(path.endswith(".data/data/share/man/man1/swarmc.1") for path in packed)


def test_the_package_is_the_installed_one(installed, folder):
    shown = run_ok(
        installed / "python", "-c", "import swarmdsl; print(swarmdsl.__file__)", cwd=folder
    )
    assert str(folder / "venv") in shown
    assert swarmdsl.__version__ in run_ok(installed / "swarmc", "--version", cwd=folder)


def test_examples_build_from_another_folder(installed, folder):
    for target in ("scxml", "adf", "smach"):
        made = folder / "made"
        example = folder / "examples" / "search_and_rescue"
        run_ok(installed / "swarmc", "build", example, "-t", target, "-o", made, cwd=folder)
        assert any(path.is_file() for path in (made / target).rglob("*"))


def test_pages_are_there(installed, folder):
    assert "SW0908 would-overwrite" in run_ok(installed / "swarmc", "explain", "SW0908", cwd=folder)


def test_textx_knows_the_language_and_the_targets(installed, folder):
    assert "swarm (*.swarm)" in run_ok(installed / "textx", "list-languages", cwd=folder)
    listed = run_ok(installed / "textx", "list-generators", cwd=folder)
    assert all(f"swarm -> {target}" in listed for target in ("scxml", "adf", "smach"))
    example = Path("examples") / "minimal" / "blinker.swarm"
    assert "OK" in run_ok(installed / "textx", "check", example, cwd=folder)


def test_a_plug_in_is_a_target_like_any_other(installed, folder):
    assert "Who is in a swarm" in run_ok(installed / "swarmc", "targets", cwd=folder)
    example = folder / "examples" / "minimal"
    command = ("build", example, "-t", "roster", "--option", "roster.style=markdown")
    run_ok(installed / "swarmc", *command, "-o", "made", cwd=folder)
    assert (folder / "made/roster/Blinkers.txt").read_text() == "- blinker [2..*]\n"


def test_a_new_project_works(installed, folder):
    run_ok(installed / "swarmc", "new", "yard", cwd=folder)
    assert "no errors" in run_ok(installed / "swarmc", "check", "yard", cwd=folder)
    run_ok(
        installed / "swarmc",
        "add",
        "event",
        "Dark",
        "std_msgs/Empty",
        "--model",
        "yard",
        cwd=folder,
    )


def test_libraries_are_found_the_shipped_one_and_those_of_other_packages(installed, folder):
    model = """import cpswarm.functions.*
import warehouse.shelves.*
statemachine Fetch {
  initial Lift
  state Lift {
    do lift(shelf = 3)
    on succeeded -> Land
    on aborted   -> Down
  }
  state Land {
    do uav_mavros_land
    on succeeded, aborted -> Down
  }
  final Down
}
"""
    (folder / "fetch.swarm").write_text(model, encoding="utf-8")
    said = run_ok(installed / "swarmc", "check", "fetch.swarm", cwd=folder)
    assert said.startswith("no errors in ")
