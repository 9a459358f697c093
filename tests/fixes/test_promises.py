"""`--fix` fixes all that `swarmc check` promises to fix; what it does not fix has a reason."""

import re

import pytest

from swarmdsl.cli import run as command

MODEL = """\
event Stop : std_msgs/Empty

function go : abstraction {
  service "go" : std_srvs/Trigger
}

endless statemachine Patrol {
  var n : int32 = 0

  initial Home

  state Home {
    do go
    on succeeded [n < 3] / n = n + 1 -> Home
    on succeeded, aborted, Stop -> Home
    after 1 s -> Home
  }
}

member Robot {
  behavior Patrol
  contract Stops : on Stop within 1 s reach Home
}

swarm Field {
  robot : Robot[2]
  heartbeat 1 s lost after 5 s
}
"""


@pytest.fixture
def fixed(tmp_path, capsys):
    """Check and fix a model with replacements; the promise, the text after it, and what is said."""

    def run(*changes, unsafe=True):
        text = MODEL
        for old, new in changes:
            assert old in text
            text = text.replace(old, new, 1)
        path = tmp_path / "field.swarm"
        path.write_text(text)
        command(["check", str(path)])
        promise = re.search(r"(\d+) problems? can be fixed", capsys.readouterr().err)
        options = ["--unsafe-fixes"] if unsafe else []
        command(["check", str(path), "--fix", *options])
        said = capsys.readouterr().err
        done = re.search(r"(\d+) problems? in 1 file fixed", said)
        if unsafe:
            assert (promise and promise[1]) == (done and done[1])
        return path.read_text(), said

    return run


def test_the_model_has_no_faults(fixed):
    assert fixed() == (MODEL, "no errors in 1 file\n")


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("after 1 s", "after 1 sec"),
        ("within 1 s", "within 1 secs"),
        ("within 1 s", "within 1 second"),
        ("heartbeat 1 s", "heartbeat 1 secs"),
        ("lost after 5 s", "lost after 5 seconds"),
    ],
)
def test_units_with_their_numbers(fixed, right, wrong):
    assert fixed((right, wrong), unsafe=False)[0] == MODEL


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("lost after 5 s", "lost 5 s"),
        ("behavior Patrol", "behaviour Patrol"),
        ("behavior Patrol", "beharior Patrol"),
        ("var n", "vaar n"),
        ("on succeeded, aborted", "on suceeded, abroted"),
    ],
)
def test_misspelled_words(fixed, right, wrong):
    assert fixed((right, wrong))[0] == MODEL


def test_a_fix_that_shows_a_hidden_mistake(fixed):
    text, _ = fixed(("[n < 3]", '[nn < "3"]'))
    assert text == MODEL.replace("[n < 3]", '[n < "3"]')
    assert fixed(("behavior Patrol", "behavior Patrl"), ("reach Home", "reach Hoem"))[0] == MODEL
    text, _ = fixed(("behavior", "behaviour"), ("contract Stops", "contract"))
    assert text == MODEL.replace("contract Stops", "contract Reacts")


def test_a_refused_fix_has_a_reason(fixed):
    text, said = fixed(("heartbeat 1 s lost after 5 s", "heartbeat 1 secs"))
    assert "heartbeat 1 secs\n" in text
    assert (
        "field.swarm:27: not fixed: SW0101: Change to `1 s`: "
        "SW0101 would come in line 27: expected `lost`" in said
    )


def test_a_fix_in_a_file_with_syntax_errors_has_a_reason(fixed):
    text, said = fixed(("heartbeat 1 s lost", "heartbeat lost"), ("-> Home", "-> Hoem"))
    assert "-> Hoem" in text
    assert "Change to `Home`: the file has syntax errors\n" in said
