"""Proofs under the conditions of a scenario, and with functions that may never answer."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.cli import run

_FIELD = """package field
swarm event Ask : std_msgs/Empty
swarm event Yes : std_msgs/Empty
message Number { n : int32 }
event Seen : Number
action Try { result { ok : bool } }
function land : abstraction { action "land" : Try }
statemachine Fly {
  param limit : int32
  var ok : bool
  initial Circle
  state Circle { on Seen [event.n < limit] / send Ask -> Wait }
  state Wait { on Yes -> Land }
  state Land {
    do land gives (ok => ok)
    on succeeded [ok] -> Down
    on succeeded -> Bad
    on aborted -> Land
    on preempted -> Circle
  }
  state Bad { on Yes -> Down }
  final Down
}
endless statemachine Watch {
  initial Ready
  state Ready { on Ask / send Yes -> Ready }
}
member Drone {
  param limit : int32 = 0
  behavior Fly
}
member Tower { behavior Watch }
swarm Field {
  drone : Drone[1..3]
  tower : Tower
}
"""
_SEEN = """
[[messages]]
event = "Seen"
at = "3 s"
to = "drone[0]"
data = { n = 3 }
"""


def verified(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    scenario: str,
    *properties: str,
    options: tuple[str, ...] = (),
) -> tuple[list[str], str]:
    """Return the verdicts on properties under a scenario, and all that is told."""
    named = "\n".join(f"property P{n} of Field : {text}" for n, text in enumerate(properties))
    (folder / "field.swarm").write_text(_FIELD + named, encoding="utf-8")
    (folder / "field.toml").write_text(scenario, encoding="utf-8")
    asked = ["verify", str(folder / "field.swarm"), "--scenario", str(folder / "field.toml")]
    for number in range(len(properties)):
        asked += ["--property", f"P{number}"]
    run([*asked, *options])
    told = capsys.readouterr()
    lines = [line.split() for line in told.out.splitlines()]
    return [line[1] for line in lines if line[:1] and line[0][:1] == "P"], told.out + told.err


def test_numbers_and_params_are_those_of_the_scenario(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "[count]\ndrone = 2\n[params.drone]\nlimit = LIMIT\n" + _SEEN
    never = "never some drone in Wait"

    verdicts, told = verified(tmp_path, capsys, text.replace("LIMIT", "5"), never)
    assert (verdicts, "Field: 2 drone, 1 tower" in told) == (["fails"], True)
    verdicts, _ = verified(tmp_path, capsys, text.replace("LIMIT", "3"), never)
    assert verdicts == ["holds"]
    # An option chooses another number.
    _, told = verified(
        tmp_path, capsys, text.replace("LIMIT", "3"), never, options=("--size", "drone=3")
    )
    assert "Field: 3 drone, 1 tower" in told


def test_messages_come_as_often_as_in_the_scenario(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = ("each drone : hears Seen at most 1 times", "never drone[1] hears Seen")
    count = "[count]\ndrone = 2\n"

    verdicts, told = verified(tmp_path, capsys, count + _SEEN, *asked)
    assert verdicts == ["holds", "holds"]
    assert "from outside, as often as in the scenario, at any time: `Seen`" in told
    verdicts, _ = verified(tmp_path, capsys, count + _SEEN * 2, *asked)
    assert verdicts == ["fails", "holds"]
    often = _SEEN + 'every = "1 s"\n'
    verdicts, told = verified(tmp_path, capsys, count + often, *asked)
    assert verdicts == ["fails", "holds"]
    assert "from outside, at any time and any number of times: `Seen`" in told
    everybody = _SEEN.replace('to = "drone[0]"', 'to = "drone"')
    verdicts, _ = verified(tmp_path, capsys, count + everybody, *asked)
    assert verdicts == ["holds", "fails"]
    verdicts, told = verified(tmp_path, capsys, count, *asked)
    assert (verdicts, "nothing comes from outside" in told) == (["holds", "holds"], True)


def test_functions_end_as_in_the_scenario(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = (
        "each drone : in Circle at most 1 times",
        "each drone : in Land leads to in Down or in Bad",
        "never some drone in Bad",
    )
    base = f"[params.drone]\nlimit = 5\n{_SEEN}"
    cases = {
        "": ["holds", "holds", "fails"],
        "aborted = 0.1": ["holds", "fails", "fails"],
        "preempted = 0.1": ["fails", "fails", "fails"],
        "results = [{ ok = true }]": ["holds", "holds", "holds"],
        "never = 0.1": ["holds", "fails", "fails"],
        "aborted = 1": ["holds", "fails", "holds"],
    }
    for line, verdicts in cases.items():
        found, told = verified(tmp_path, capsys, f"{base}\n[functions.land]\n{line}\n", *asked)
        assert (line, found) == (line, verdicts)
        assert "functions end in the ways that the scenario gives a probability" in told
        assert ("`land` may never end" in told) == line.startswith("never")
    # A robot may have another behavior, as this one that gets no event.
    other = f'{base}\n[count]\ndrone = 2\n[functions.land.of."drone[1]"]\npreempted = 0.5\n'
    assert verified(tmp_path, capsys, other, *asked)[0] == ["holds", "holds", "fails"]
    mine = other.replace("drone[1]", "drone[0]")
    assert verified(tmp_path, capsys, mine, *asked)[0] == ["fails", "fails", "fails"]


_RELIABLE = """package cut
swarm event Tell : std_msgs/Empty { reliable }
statemachine Say {
  initial Wait
  state Wait { after 5 s / send Tell -> Done }
  final Done
}
statemachine Hear {
  initial Wait
  state Wait { on Tell -> Done }
  final Done
}
member Speaker { behavior Say }
member Hearer { behavior Hear }
swarm Talk {
  speaker : Speaker
  hearer  : Hearer
}
property P of Talk : speaker sends Tell leads to hearer in Done
"""
_APART = '[[faults]]\nat = "1 s"\napart = [["speaker"], ["hearer"]]\n'


def test_a_reliable_event_is_lost_in_a_network_that_is_cut_for_ever(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, scenario = tmp_path / "cut.swarm", tmp_path / "cut.toml"
    model.write_text(_RELIABLE, encoding="utf-8")
    for text, outcome in {
        "[network]\nloss = 0.5\n": "holds",
        "[network]\nloss = 1.0\n": "fails",
        f'{_APART}lasts = "1 min"\n': "holds",
        _APART: "fails",
    }.items():
        scenario.write_text(text, encoding="utf-8")
        run(["verify", str(model), "--property", "P", "--scenario", str(scenario)])
        told = capsys.readouterr().out
        assert (text, f"P  {outcome}" in told) == (text, True)
        assert ("may be lost but `Tell`" in told) == (outcome == "holds")


_PLACES = """package places
function put : abstraction {
  service "put" : std_srvs/Empty
  model place(time = 2 s)
}
statemachine Work {
  initial Go
  state Go {
    do put
    on succeeded -> Done
    on aborted -> Failed
  }
  final Done
  final Failed
}
member Robot {
  behavior Work
  body { radius = 0.2 m, speed = 1 m/s }
}
swarm Yard { robot : Robot }
property P of Yard : never robot in Failed
"""


def test_functions_that_move_robots_end_in_any_way_where_these_have_places(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, scenario = tmp_path / "yard.swarm", tmp_path / "yard.toml"
    model.write_text(_PLACES, encoding="utf-8")
    for text, outcome in {
        "": "fails",
        '[world]\nkind = "flat"\n': "fails",
        '[world]\nkind = "abstract"\n': "holds",
        "[functions.put]\naborted = 0.0\n": "holds",
    }.items():
        scenario.write_text(text, encoding="utf-8")
        run(["verify", str(model), "--property", "P", "--scenario", str(scenario)])
        told = capsys.readouterr().out
        assert (text, f"P  {outcome}" in told) == (text, True)
        assert ("a probability, `put` in any" in told) == (outcome == "fails")
        assert ("places are left out" in told) == ("abstract" not in text)


def test_loss_and_faults_are_those_of_the_scenario(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = ("each drone : in Wait leads to in Land",)
    base = f"[params.drone]\nlimit = 5\n{_SEEN}"
    lost = '[[faults]]\nat = "5 s"\nlost = "{}"\n'

    assert verified(tmp_path, capsys, base, *asked)[0] == ["holds"]
    found, told = verified(tmp_path, capsys, f"{base}[network]\nloss = 0.1\n", *asked)
    assert (found, "any of them may be lost" in told) == (["fails"], True)
    found, told = verified(tmp_path, capsys, base + lost.format("tower"), *asked)
    assert (found, "at most 1 robot lost of `tower[0]`" in told) == (["fails"], True)
    # The robots that it is about, and those that stay, are not lost.
    assert verified(tmp_path, capsys, base + lost.format("drone"), *asked)[0] == ["holds"]
    found, _ = verified(
        tmp_path, capsys, base + lost.format("tower"), *asked, options=("--faults", "0")
    )
    assert found == ["holds"]
    found, told = verified(
        tmp_path, capsys, base + lost.format("tower") + 'lasts = "3 s"\n', "never drone[0] in Bad"
    )
    assert (found, "of `tower[0]`, at any time, until it starts anew" in told) == (["fails"], True)
    silent = '[[faults]]\nat = "5 s"\nsilent = "land"\n'
    found, told = verified(
        tmp_path, capsys, base + silent, "each drone : in Land leads to in Down or in Bad"
    )
    assert (found, "`land` may never end" in told) == (["fails"], True)


def test_latencies_of_the_scenario_rule_runs_out(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    base = f"[params.drone]\nlimit = 5\n{_SEEN}"
    late = _FIELD.replace("state Wait {", "state Wait {\n after 2 s -> Bad\n")
    asked = "never some drone in Bad"
    swarm, toml = tmp_path / "late.swarm", tmp_path / "late.toml"
    late = late.replace("on succeeded -> Bad", "on succeeded -> Down")
    swarm.write_text(f"{late}property P0 of Field : {asked}\n")
    for latency, outcome in (("500 ms", "unknown"), ("2 s", "fails")):
        toml.write_text(f'{base}[network]\nlatency = "{latency}"\n')
        run(["verify", str(swarm), "--scenario", str(toml), "--property", "P0"])
        assert f"P0  {outcome}" in capsys.readouterr().out


def test_a_param_without_a_value_gets_it_from_the_scenario(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, scenario = tmp_path / "field.swarm", tmp_path / "field.toml"
    alone = _FIELD[: _FIELD.index("endless")] + "property P of Fly : never in Wait\n"
    model.write_text(alone, encoding="utf-8")
    scenario.write_text("[params]\nlimit = 0\n", encoding="utf-8")

    assert run(["verify", str(model), "--machine", "Fly"]) == 1
    assert "set it in `[params]` of a scenario" in capsys.readouterr().out
    assert run(["verify", str(model), "--machine", "Fly", "--scenario", str(scenario)]) == 0
    scenario.write_text('[params]\nlimit = 5\n[[messages]]\nevent = "Seen"\nat = "1 s"\n')
    assert run(["verify", str(model), "--machine", "Fly", "--scenario", str(scenario)]) == 1


def test_numbers_of_members_are_for_swarms(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    verified(tmp_path, capsys, "[count]\ndrone = 2\n", "never drone[0] in Bad")
    alone = ["verify", str(tmp_path / "field.swarm"), "--machine", "Fly"]

    assert run([*alone, "--scenario", str(tmp_path / "field.toml")]) == 1
    told = capsys.readouterr().out
    assert "SW0012]: a scenario of a machine alone has no key `count`" in told
    assert "help: counts are for swarms" in told
    assert run([*alone, "--size", "drone=2"]) == 1
    assert "help: sizes are for swarms" in capsys.readouterr().out


def test_mistakes_in_options_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, told = verified(tmp_path, capsys, "[count]\ndrones = 2\n", "never drone[0] in Bad")
    assert "no role called `drones`" in told
    _, told = verified(tmp_path, capsys, "", "never drone[0] in Bad", options=("--never", "lamd"))
    assert "no function called `lamd`" in told
    assert "did you mean `land`?" in told
    assert run(["verify", str(tmp_path / "field.swarm"), "--scenario", "no.toml"]) == 1
    assert "no.toml" in capsys.readouterr().out


def test_a_function_may_never_answer(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model, test = tmp_path / "field.swarm", tmp_path / "field.swarmtest.toml"
    text = _FIELD.replace("= 0\n  behavior", "= 5\n  behavior")
    text = text.replace(
        "    on aborted -> Land\n    on preempted -> Circle\n",
        "    on aborted, preempted -> Down\n",
    )
    text += "property Ends of Field : each drone : in Land leads to in Down or in Bad\n"
    text += "property Once of Field : each drone : in Land at most 1 times\n"
    model.write_text(text, encoding="utf-8")

    assert run(["verify", str(model), "--property", "Ends"]) == 0
    capsys.readouterr()
    asked = ["--property", "Ends", "--property", "Once", "--never", "land"]
    assert run(["verify", str(model), *asked, "--save-test", str(test)]) == 1
    told = capsys.readouterr().out
    assert "but `land` may never end" in told
    assert "Once  holds" in told
    assert "nothing happens to `" in told
    # With a way out after a time, it holds again.
    mended = text.replace("    do land", "    after 1 min -> Down\n    do land")
    model.write_text(mended, encoding="utf-8")
    assert run(["verify", str(model), "--property", "Ends", "--never", "land"]) == 0


def test_params_of_a_scenario_are_those_of_saved_tests(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    test = tmp_path / "field.swarmtest.toml"
    verified(
        tmp_path,
        capsys,
        f"[params.drone]\nlimit = 5\n{_SEEN}",
        "never some drone in Wait",
        options=("--save-test", str(test)),
    )

    assert "params = { drone = { limit = 5 } }" in test.read_text()
    assert run(["test", str(test)]) == 1
    assert "FAILED  P0" in capsys.readouterr().out
