"""`swarmc` as a process: signals, pipes, full disks and what it imports."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

posix = pytest.mark.skipif(os.name != "posix", reason="signals and limits of POSIX")

ROOT = Path(__file__).resolve().parents[2]

# What these import themselves.
CLICK = LXML = {"inspect"}
# To find libraries in Python packages.
LIBRARIES = {"importlib.metadata"}
HEAVY = (
    "click",
    "dataclasses",
    "inspect",
    "textx",
    "arpeggio",
    "lark",
    "jinja2",
    "lxml",
    "rich",
    "pygls",
    "importlib.metadata",
)


@pytest.mark.parametrize(
    ("arguments", "allowed"),
    [
        (["--version"], {"click", *CLICK}),
        (["--help"], {"click", *CLICK}),
        (["check", "--help"], {"click", *CLICK}),
        (["check", "examples/minimal"], set()),
        (["check", "examples/search_and_rescue"], LIBRARIES),
        (
            ["check", "examples/search_and_rescue", "tests/diagnostics/SW0103_state.swarm"],
            LIBRARIES,
        ),
        (["build", "examples/minimal", "-t", "adf", "-o", "OUT"], set()),
        (["build", "examples/minimal", "-t", "scxml", "-o", "OUT"], {"lxml", *LXML}),
        (["fmt", "--check", "examples/minimal"], {"click", *CLICK}),
    ],
)
def test_only_what_is_needed_is_imported(arguments, allowed, tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    monkeypatch.delenv("FORCE_COLOR", raising=False)
    arguments = [str(tmp_path) if word == "OUT" else word for word in arguments]
    assert imported(arguments) <= allowed


def test_a_project_file_and_options_in_it_cost_little_to_read(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("swarm.toml").write_text("[project]\nname = 'p'\n[targets.smach]\nsimulation = true\n")
    Path("model.swarm").write_text("package p\n")
    assert imported(["check"]) == set()


def imported(arguments):
    """Return the slow modules that a command imported."""
    code = (
        "import sys\nfrom swarmdsl.cli import run\n"
        f"run({arguments!r})\n"
        f"print([name for name in {HEAVY!r} if name in sys.modules], file=sys.stderr)"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(eval(ran.stderr.splitlines()[-1]))


def test_a_package_of_smach_costs_jinja_alone(tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    monkeypatch.delenv("FORCE_COLOR", raising=False)
    found = imported(["build", "examples/minimal", "-t", "smach", "-o", str(tmp_path)])
    assert found == {"jinja2", "inspect"}


def test_a_model_without_mistakes_needs_no_colours(monkeypatch):
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("FORCE_COLOR", "1")
    code = (
        "import sys\nfrom swarmdsl.cli import run\nrun(['check', 'examples/minimal'])\n"
        "sys.exit('rich' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_a_check_imports_no_later_phase(tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    later = (
        *("dataclasses", "decimal", "hashlib", "json", "logging", "xml.etree"),
        *("codegen", "lowering", "output", "syntax.pegen", "syntax.recovery"),
        *("base.diagnostics.catalog", "base.diagnostics.explain"),
        *("driver.config.lint", "syntax.errors"),
        *("ir.expressions", "ir.statemachine"),
    )
    code = (
        "import sys\nfrom swarmdsl.cli import run\nrun(['check', 'examples/minimal'])\n"
        "known = {name.removeprefix('swarmdsl.') for name in sys.modules}\n"
        f"sys.exit(', '.join(known & {{*{later!r}}}))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ran.stderr.splitlines()[1:] == [""]


@posix
def test_what_is_to_be_done_at_the_end_is_done(good):
    code = (
        "import atexit, sys\nfrom swarmdsl.cli import main\n"
        "atexit.register(print, 'the end')\n"
        f"sys.argv[1:] = ['check', {str(good)!r}]\nmain()"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (ran.returncode, ran.stdout) == (0, "the end\n")


def test_debug_shows_where_a_bug_of_ours_is(tmp_path):
    code = (
        "import sys\nfrom swarmdsl import cli\nfrom swarmdsl.driver import pipeline\n"
        "pipeline.check = lambda *_: {}['gone']\n"
        "sys.exit(cli.run(['check', '--debug']))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ran.returncode == 3
    assert "Traceback (most recent call last)" in ran.stderr
    assert "KeyError: 'gone'" in ran.stderr


@posix
def test_a_closed_pipe_ends_it_quietly(spawn):
    process = spawn("explain")
    process.stdout.close()
    assert process.stderr.read() == b""
    assert process.wait() == -signal.SIGPIPE
    process.stderr.close()


@posix
def test_a_full_disk_behind_stdout_is_an_error(spawn):
    with Path("/dev/full").open("wb") as full:
        process = spawn("explain", stdout=full)
        _, err = process.communicate()
    assert process.returncode == 1
    assert err.decode() == "swarmc: cannot write the output: No space left on device\n"


@posix
def test_a_closed_stdout_changes_no_result(good):
    command = f'"{sys.executable}" -m swarmdsl check "{good}" >&-'
    ran = subprocess.run(["sh", "-c", command], capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (0, "no errors in 1 file\n")


@posix
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_it_quietly(spawn, number, code):
    process = spawn("fmt", "-", stdin=subprocess.PIPE)
    # The pipe holds 64 kB: the rest is taken when swarmc is at work and reads.
    process.stdin.write(b" " * 2**20)
    process.send_signal(number)
    out, err = process.communicate()
    assert (process.returncode, out, err.strip()) == (code, b"", b"")


@posix
def test_a_disk_that_fills_up_leaves_the_output_as_it_was(good, tmp_path):
    """A limit on the size of files stands for the disk: it stops a write in the middle."""
    made = tmp_path / "made"
    code = (
        "import resource, sys\nfrom swarmdsl.cli import run\n"
        "from swarmdsl.codegen import registry\n"
        "from swarmdsl.codegen.api import Generator, OutputFile\n"
        "limited = lambda system, options, report: [\n"
        "    OutputFile('small', 'x'), OutputFile('large', 'x' * 100_000)]\n"
        "generator = Generator('t', '', limited)\n"
        "registry.BUILT_IN['t'] = '__main__:generator'\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))\n"
        f"sys.exit(run(['build', {str(good)!r}, '-t', 't', '-o', {str(made)!r}]))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ran.returncode == 1
    assert f"error[SW0909]: cannot write `{made}/t/large`: file too large" in ran.stdout
    assert not made.exists()


@posix
def test_a_terminal_without_unicode_shows_what_it_can(spawn, tmp_path):
    path = tmp_path / "日本.swarm"
    path.write_text("state Größe", encoding="utf-8")
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    process = spawn("check", path, env=environment)
    out, err = process.communicate()
    assert process.returncode == 1
    assert b"\\u65e5\\u672c.swarm:1:1" in out
    assert b"Traceback" not in err


@posix
def test_a_file_name_that_is_not_unicode(spawn, tmp_path):
    path = os.fsencode(tmp_path) + b"/\xff.swarm"
    Path(os.fsdecode(path)).write_text("state X")
    process = spawn("check", os.fsdecode(path))
    out, err = process.communicate()
    assert process.returncode == 1
    assert b"error[" in out
    assert b"Traceback" not in err
