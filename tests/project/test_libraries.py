"""Search path of `import package.*`, and the declarations it adds to a system."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl import ir
from swarmdsl.base import resources
from swarmdsl.driver import pipeline
from swarmdsl.driver.config.settings import Settings
from swarmdsl.project.libraries import GROUP

ROOT = Path(__file__).resolve().parents[2]
WAREHOUSE = ROOT / "tests" / "plugins" / "warehouse" / "swarmdsl_warehouse"

USER = """package user
import {package}.*
statemachine M {{
  initial S
  state S {{
    do {call}
    on succeeded, aborted -> F
  }}
  final F
}}
"""
KIT = 'package kit\nfunction go : abstraction {{ service "{name}" : std_srvs/Empty }}\n'


@pytest.fixture
def install(tmp_path: Path, monkeypatch) -> Callable[..., None]:
    """Install a module with an entry point for libraries as pip does."""
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(site)

    def add(name: str, module: str, files: dict[str, str]) -> Path:
        for path, text in files.items():
            (site / module / path).parent.mkdir(parents=True, exist_ok=True)
            (site / module / path).write_text(text, encoding="utf-8")
        info = site / f"{name}-1.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1\n")
        (info / "entry_points.txt").write_text(f"[{GROUP}]\n{name} = {module}\n")
        return site / module

    return add


def test_the_search_order(project, install, tmp_path, monkeypatch) -> None:
    """Each place wins when the places before it are removed."""
    shipped = tmp_path / "shipped"
    installed = install("kits", "kits", {"kit.swarm": KIT.format(name="place5")})
    root = project(
        {
            "models/main.swarm": USER.format(package="kit", call="go"),
            "models/kit.swarm": KIT.format(name="place0"),
            "kit.swarm": KIT.format(name="place1"),
            "lib/kit/any.swarm": KIT.format(name="place2"),
            "../other/kit.swarm": KIT.format(name="place3"),
            "../shipped/kit.swarm": KIT.format(name="place4"),
            "swarm.toml": "[project]\nlibraries = ['lib', '../other']\n",
        }
    )
    monkeypatch.setattr(resources, "library", lambda: shipped)
    places = [root / "models", root, root / "lib" / "kit", tmp_path / "other", shipped, installed]
    found = []
    for place in places:
        settings = Settings(libraries=(root, root / "lib", tmp_path / "other"))
        system = pipeline.check([root / "models" / "main.swarm"], settings).system
        assert system is not None
        found += [function.communication.name for function in system.functions]
        (next(place.glob("*.swarm")) if place.name == "kit" else place / "kit.swarm").unlink()

    assert found == [f"place{number}" for number in range(6)]


def test_the_project_file_names_libraries(swarmc, project, monkeypatch) -> None:
    root = project(
        {
            "swarm.toml": "[project]\nsources = ['models']\nlibraries = ['lib']\n",
            "models/main.swarm": USER.format(package="kit", call="go"),
            "lib/kit.swarm": KIT.format(name="x"),
        }
    )
    assert swarmc("check").err == "no errors in 1 file\n"

    monkeypatch.chdir(root / "models")
    assert swarmc("check", "main.swarm").code == 0
    (root / "swarm.toml").write_text("")
    assert "SW0008" in swarmc("check", "main.swarm").out


def test_a_library_in_a_package_of_its_own(swarmc, project, install) -> None:
    site = install("warehouse", "swarmdsl_warehouse", {"x": ""})
    shutil.copytree(WAREHOUSE, site, dirs_exist_ok=True)
    project({"main.swarm": USER.format(package="warehouse.shelves", call="lift(shelf = 3)")})
    ran = swarmc("check")

    assert (ran.out, ran.err) == ("", "no errors in 1 file\n")


def test_a_similar_name_in_an_installed_library(swarmc, project, install) -> None:
    install("kits", "kits", {"kit.swarm": KIT.format(name="place4")})
    project({"main.swarm": USER.format(package="kitt", call="go")})

    assert "did you mean `kit`?" in swarmc("check").out


@pytest.mark.parametrize(
    ("module", "files", "reason"),
    [
        ("nowhere", {}, "there is no module `nowhere`"),
        ("nowhere.below", {}, "No module named 'nowhere'"),
        ("bare", {"__init__.py": ""}, "no .swarm file is in the folder of `bare`"),
        # The error is another one where a package has brought its own importlib_metadata.
        ("a b", {}, "Error: "),
    ],
)
def test_a_broken_library_does_not_break_the_others(
    swarmc, project, install, module, files, reason
) -> None:
    install("kits", "kits", {"kit.swarm": KIT.format(name="place4")})
    install("abroken", module, files)
    project({"main.swarm": USER.format(package="kit", call="go")})
    ran = swarmc("check", "--format", "concise")

    assert ran.code == 0
    assert ran.out.startswith("warning[SW0010] cannot load library `abroken`: ")
    assert reason in ran.out
    assert swarmc("check", "--allow", "broken-library").out == ""


def test_installed_libraries_are_not_looked_at_without_need(swarmc, project, install) -> None:
    install("broken", "nowhere", {})
    project(
        {
            "main.swarm": USER.format(package="kit", call="go"),
            "kit.swarm": KIT.format(name="x"),
        }
    )

    assert swarmc("check").out == ""


# ---- used declarations of a library


def compiled(text: str, folder: Path) -> ir.System:
    path = folder / "main.swarm"
    path.write_text(text, encoding="utf-8")
    result = pipeline.check([path])
    assert result.system is not None, [found.message for found in result.report]
    return result.system


def test_only_used_declarations_of_a_library_are_in_the_system(tmp_path) -> None:
    call = 'task_allocation_auction(auctioneer = "", task_id = "t", task_pose = pose)'
    text = USER.format(package="cpswarm.functions", call=call)
    text = text.replace("initial S", "var pose : geometry_msgs/PoseStamped\n  initial S")
    system = compiled(text, tmp_path)

    assert [function.name for function in system.functions] == ["task_allocation_auction"]
    own = {str(interface.type) for interface in system.interfaces if "cpswarm" in str(interface)}
    assert own == {
        *("cpswarm_msgs/TaskAllocation", "cpswarm_msgs/TaskAllocatedEvent"),
        "cpswarm_msgs/TaskAllocationEvent",
    }
    assert system.events == ()
    assert system.name == "user"


def test_a_mission_of_shipped_parts(swarmc, project) -> None:
    mission = """package mission
import cpswarm.events.*
import cpswarm.functions.*
statemachine Sweep {
  initial Idle
  state Idle { on MissionStart -> Rise }
  state Rise {
    do uav_mavros_takeoff(altitude = 3.0)
    on succeeded -> Search
    on aborted   -> Landing
  }
  state Search {
    do uav_random_coverage(altitude = 3.0)
    on succeeded, aborted, MissionAbort -> Landing
  }
  state Landing {
    do uav_mavros_land
    on succeeded -> Down
    on aborted   -> Landing
  }
  final Down
}
"""
    root = project({"mission.swarm": mission})
    assert swarmc("build", "-t", "scxml", "-t", "adf").code == 0
    written = "\n".join(p.read_text() for p in (root / "out").rglob("*/*") if p.is_file())
    for name in ("MissionStart", "cmd/takeoff", "uav_random_coverage", "cmd/land"):
        assert name in written
    for name in ("TargetFound", "rois/assign", "ugv_coverage"):
        assert name not in written


def test_only_errors_of_a_library_are_reported(tmp_path) -> None:
    (tmp_path / "kit").mkdir()
    wrong = "package kit.wrong\nstatemachine Idle { state wait; final Done }\n"
    (tmp_path / "kit" / "wrong.swarm").write_text(wrong, encoding="utf-8")
    (tmp_path / "model.swarm").write_text(
        "import kit.wrong.*\n"
        "statemachine Main { initial A; state A = Idle { on done -> Z } final Z }\n",
        encoding="utf-8",
    )

    found = pipeline.check([tmp_path / "model.swarm"])

    # The style of the state `wait` is not reported: users cannot change the library.
    assert [(each.name, each.primary.span.line) for each in found.report] == [
        ("missing-initial", 2)
    ]


def test_only_the_events_that_are_used_of_a_library_have_topics(swarmc, project) -> None:
    library = "package robots\nevent Battery : std_msgs/Float32\nevent Bumper : std_msgs/Float32\n"
    main = """\
import robots.*
statemachine Watch {
  initial Waiting
  state Waiting {
    on Battery                       -> Done
    monitor "battery" : std_msgs/Bool -> Done
    monitor "bumper"  : std_msgs/Bool -> Done
  }
  final Done
}
"""
    project(
        {
            "swarm.toml": "[project]\nsources = ['main.swarm']\n",
            "main.swarm": main,
            "robots.swarm": library,
        }
    )

    # The mistake is in the project, not in the library.
    assert swarmc("check", "--format", "concise").out == (
        "main.swarm:6:25: error[SW0612] topic `battery` carries `std_msgs/Float32`, "
        "not `std_msgs/Bool`\n"
    )
