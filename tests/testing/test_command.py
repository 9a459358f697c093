"""`swarmc test`: which tests run, what is printed where, exit codes, files for CI."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from io import StringIO
from pathlib import Path

import pytest
from lxml import etree

from swarmdsl.execution.simulate.evaluation.coverage import Coverage
from swarmdsl.execution.testing.console import Console

from .conftest import Ran

TWO = """[[test]]
name  = "lamps wait"
steps = [{ in = "Off", for = "1 h" }]

[[test]]
name  = "lamps are on"
steps = [{ in = "On" }]
"""
FINE = TWO.partition("\n\n")[0] + "\n"


def write(folder: Path, **files: str) -> None:
    for name, text in files.items():
        path = folder / f"{name.replace('__', '/')}.swarmtest.toml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")


def test_results_failures_and_a_summary(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, a=TWO)
    found = swarmc("test")

    assert found.code == 1
    assert (
        found.out
        == """a.swarmtest.toml
  ok      lamps wait
  FAILED  lamps are on

error[SW1101]: expected in `On`
 --> a.swarmtest.toml:7:17
  |
7 | steps = [{ in = "On" }]
  |                 ^^^^ at the start: `lamp[0]`, `lamp[1]`, `lamp[2]` and `spare[0]` are in `Off`
  = note: in the test `lamps are on`

the last trace lines:
     0.000  lamp[0]  (start) -> Off
     0.000  lamp[0].eye  (start) -> Off
     0.000  lamp[1]  (start) -> Off
     0.000  lamp[1].eye  (start) -> Off
     0.000  lamp[2]  (start) -> Off
     0.000  lamp[2].eye  (start) -> Off
     0.000  spare[0]  (start) -> Off
     0.000  spare[0].eye  (start) -> Off
"""
    )
    assert re.fullmatch(r"1 passed, 1 failed in \d+\.\d\d s\n", found.err)


def test_files_are_found_below_folders(swarmc: Callable[..., Ran], folder: Path) -> None:
    model = 'model = "../lamps.swarm"\n'
    write(folder, b=FINE, a=FINE, in__side=model + FINE, **{".hidden__c": model + FINE})
    (folder / "other.toml").write_text("[x]\n")

    assert [line for line in swarmc("test").out.splitlines() if line.endswith(".toml")] == [
        *("a.swarmtest.toml", "b.swarmtest.toml", "in/side.swarmtest.toml")
    ]
    # Once, however often they are named.
    again = swarmc("test", ".", "in", "a.swarmtest.toml")
    assert again.code == 0
    assert again.err.startswith("3 passed in ")


def test_a_project_says_what_the_model_is(swarmc: Callable[..., Ran], folder: Path) -> None:
    (folder / "swarm.toml").write_text('[project]\nsources = ["lamps.swarm"]\n')
    write(folder, tests__a=FINE)

    assert swarmc("test", "tests").code == 0


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["nowhere"], 1, "error[SW0001]: no such file: `nowhere`"),
        (["lamps.swarm"], 1, "error[SW0002]: `lamps.swarm` is a .swarm file, not a test file"),
        (["empty"], 1, "error[SW1102]: no test in `empty`"),
        (["-k", "nothing"], 1, "`-k nothing` leaves out all 1"),
        (["--fail-under", "101"], 2, ""),
        (["--fail-under", "nan"], 2, ""),
        (["--seed", "x"], 2, ""),
    ],
)
def test_nothing_to_run(
    swarmc: Callable[..., Ran], folder: Path, arguments: list[str], code: int, said: str
) -> None:
    (folder / "empty").mkdir()
    write(folder, a=FINE)
    found = swarmc("test", *arguments)

    assert found.code == code
    assert said in found.out


def test_a_pattern_chooses_by_name_and_file(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, one=TWO, two=TWO)

    assert swarmc("test", "-k", "WAIT").err.startswith("2 passed, 2 left out in ")
    assert swarmc("test", "-k", "two.").err.startswith("1 passed, 1 failed, 2 left out in ")
    assert swarmc("test", "-k", "two.swarmtest.toml::lamps wait").code == 0


def test_a_trace_shows_all_that_happens(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, a=FINE.replace('{ in = "Off", for = "1 h" }', '{ send = "Start" }'))

    assert "    seed 0      0.000  lamp[0]  Start -> " in swarmc("test", "--trace").out
    assert "Start" not in swarmc("test").out
    assert "    seed 7 " in swarmc("test", "--trace", "--seed", 7).out


def test_programs_get_diagnostics_alone(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, a=TWO)
    found = swarmc("test", "--format", "concise")

    assert found.out == "a.swarmtest.toml:7:17: error[SW1101] expected in `On`\n"
    assert "  FAILED  lamps are on\n" in found.err


def test_coverage_lists_what_is_not_reached(swarmc: Callable[..., Ran], folder: Path) -> None:
    steps = '{ send = "Start" }, { pass = "1 s" }, { end = "blink", result = { count = 3 } }'
    write(folder, a=FINE.replace('{ in = "Off", for = "1 h" }', steps))
    found = swarmc("test", "--coverage")

    assert found.code == 0
    assert (
        found.out.partition("\n\n")[2]
        == """coverage  states   transitions
Blinking  8 of 10  3 of 10
  never entered: On.Lamp.Broken
  never entered: Gone
  never taken: On: on Start -> Gone
  never taken: On.Lamp.Bright: on succeeded -> Bright
  never taken: On.Lamp.Bright: on aborted -> Broken
  never taken: On.Lamp.Dark: after 5 s [off] -> Bright
  never taken: On.Lamp.Broken: on Button [event.times == 3] -> Bright
  never taken: On.Sound.Loud: on succeeded -> Quiet
  never taken: On.Sound.Loud: on aborted -> Quiet
Watching  2 of 2   1 of 2
  never taken: Awake: after 1 min -> Off
58 % of all states and transitions
"""
    )


def test_what_is_missed_is_not_rounded_away(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Coverage, "percentage", 99.9)
    out = StringIO()
    Console(out, StringIO(), "text").coverage(Coverage())

    assert "99 % of all" in out.getvalue()


def test_documents_of_one_name_are_counted_apart(swarmc: Callable[..., Ran], folder: Path) -> None:
    for name, event in (("one", "go"), ("two", "stay")):
        (folder / f"{name}.scxml").write_text(
            '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="D">'
            '<state id="a"><transition event="go" target="b"/></state><final id="b"/></scxml>'
        )
        (folder / f"{name}.swarmtest.toml").write_text(
            f'model = "{name}.scxml"\n[[test]]\nname = "it"\n'
            f'steps = [{{ send = "{event}" }}, {{ pass = "1 s" }}]\n'
        )
    found = swarmc("test", "one.swarmtest.toml", "two.swarmtest.toml", "--coverage")

    rows = [" ".join(line.split()) for line in found.out.splitlines() if line.startswith("D ")]
    assert rows == ["D 2 of 2 1 of 1", "D 1 of 2 0 of 1"]


def test_too_little_coverage_fails(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, a=FINE)
    # The states Off of both machines, out of 12 states and 12 transitions.
    assert swarmc("test", "--fail-under", "8").code == 0
    found = swarmc("test", "--fail-under", "9")
    assert found.code == 1
    assert (
        "error[SW1104]: the tests cover 8.3 % of all states and transitions, but 9 % are required"
        in found.out
    )


def test_a_machine_that_is_reused_counts_once(swarmc: Callable[..., Ran], folder: Path) -> None:
    (folder / "lamps.swarm").write_text("""swarm event Go : std_msgs/Empty
statemachine Inner {
  initial A
  state A { on Go -> B }
  final B
}
statemachine Outer {
  initial One
  state One = Inner { on done -> Two }
  state Two = Inner { on done -> End }
  final End
}
member M { behavior Outer }
swarm S { m : M[1] }
""")
    write(folder, a='[[test]]\nname = "it"\nsteps = [{ send = "Go" }]\n')
    found = swarmc("test", "--coverage")

    assert "Outer     2 of 3  1 of 2" in found.out
    assert "Inner     2 of 2  1 of 1" in found.out


# ---- JUnit XML


def junit(path: Path) -> etree._Element:
    tree = etree.parse(path)
    etree.XMLSchema(file=Path(__file__).parent / "junit.xsd").assertValid(tree)
    return tree.getroot()


def test_junit_has_a_suite_for_each_file(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, a=TWO, sub__b=f'model = "../lamps.swarm"\n{FINE}', c='swarm = "x"\n')
    assert swarmc("test", "--junit", "out.xml").code == 1
    root = junit(folder / "out.xml")

    assert [root.get(key) for key in ("tests", "failures", "errors")] == ["4", "1", "1"]
    assert [suite.get("name") for suite in root] == [
        *("a.swarmtest.toml", "c.swarmtest.toml", "sub/b.swarmtest.toml")
    ]
    assert [(case.get("classname"), case.get("name")) for case in root.iter("testcase")] == [
        *(("a", "lamps wait"), ("a", "lamps are on")),
        ("c", "c.swarmtest.toml"),
        ("sub.b", "lamps wait"),
    ]
    (failure,) = root.iter("failure")
    assert failure.get("message") == "expected in `On`"
    assert failure.get("type") == "failed-expectation"
    assert "a.swarmtest.toml:7:17" in failure.text
    assert "lamp[0]  (start) -> Off" in failure.text
    (error,) = root.iter("error")
    assert error.get("message") == "no test in `c.swarmtest.toml`"


def test_junit_of_odd_names(swarmc: Callable[..., Ran], folder: Path) -> None:
    name = '<&> \\"\u00e4\U0001f916'
    write(folder, a=FINE.replace("lamps wait", name))
    assert swarmc("test", "--junit", "out.xml").code == 0
    (case,) = junit(folder / "out.xml").iter("testcase")

    assert case.get("name") == '<&> "\u00e4\U0001f916'


def test_junit_that_cannot_be_written(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, a=FINE)
    found = swarmc("test", "--junit", "no/folder/out.xml")

    assert found.code == 1
    assert "error[SW0909]: cannot write `no/folder/out.xml`" in found.out


# ---- in a process of its own


def test_an_interrupt_tells_what_is_known(folder: Path) -> None:
    endless = 'steps = [{ send = "Start" }, { pass = "300000 h" }]'
    write(folder, a=FINE, b=f'[[test]]\nname = "for ever"\n{endless}\n')
    command = [sys.executable, "-m", "swarmdsl", "test"]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        while "b.swarmtest.toml" not in process.stdout.readline():
            assert process.poll() is None
        process.send_signal(signal.SIGINT)
        err = process.stderr.read()

    assert process.returncode == 130
    assert err.startswith("1 passed in ")
    assert "Traceback" not in err
