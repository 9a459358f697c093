"""Seeded mistakes in an example: what `swarmc verify` says of some of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from .mutants import mutants
from .observable import Views, does_more
from .seeded import EXAMPLES, Case, Known, Original, options_of, reports, system_of

# Kind of mistake, and the text in which it is made. The rest is for `make mutants`.
FATES = {
    ("no transition", "on aborted   -> Calm"): "refused",
    ("no transition", "after 2 min  -> Search"): "same",
    ("no transition", "on SawExit [event.width >= min_width] / exit_at = event.exit -> Leaving"): (
        "checked"
    ),
    ("other target", "Calm"): "verified",
    ("opposite guard", "event.width >= min_width"): "verified",
}
WALKS = 4


def test_mistakes_are_found_and_nothing_else(examples: Path, tmp_path: Path) -> None:
    folder = examples / "emergency_exit"
    original = Original(folder, "Crowd")
    walks = [original.walk(seed) for seed in range(WALKS)]
    known = Known(walks, {(): reports(folder, "Crowd")})
    found: dict[tuple[str, str], Case] = {}
    for mutant in original.mutants():
        what = (mutant.kind, mutant.place.text)
        if what in FATES and what not in found:
            found[what] = original.judge(mutant, tmp_path / "mutant", known)

    assert known.alarms == {(): set()}
    assert {what: case.fate for what, case in found.items()} == FATES


def test_scenarios_of_the_page_of_an_example_are_used() -> None:
    folder = EXAMPLES / "agriculture"

    assert options_of(EXAMPLES / "minimal") == [()]
    assert options_of(folder) == [
        (),
        ("--scenario", str(folder / "dock.toml")),
        ("--scenario", str(folder / "treat.toml")),
        ("--scenario", str(folder / "rain.toml"), "--time", "exact"),
        ("--scenario", str(folder / "weed.toml"), "--time", "exact"),
    ]


@pytest.mark.parametrize(
    ("was", "now", "more"),
    [
        # All that it does, a blinker does whose blinks are aborted.
        ("on succeeded -> Blink", "on succeeded -> Off", False),
        ("on aborted   -> Off", "on aborted   -> Blink", False),
        # It hears a stop, and goes on.
        ("on Stop      -> Off", "on Stop      -> Blink", True),
        ("on Stop      -> Off", "", True),
        ("on succeeded -> Blink", "on succeeded / send Stop -> Blink", True),
    ],
)
def test_what_an_observer_can_tell(was: str, now: str, more: bool, tmp_path: Path) -> None:
    text = (EXAMPLES / "minimal" / "blinker.swarm").read_text(encoding="utf-8")
    assert text.count(was) == 1
    (tmp_path / "blinker.swarm").write_text(text.replace(was, now), encoding="utf-8")
    mine, other = (system_of(folder) for folder in (EXAMPLES / "minimal", tmp_path))

    views = [Views(system, system.swarms[0]) for system in (mine, other)]

    assert does_more(*views) is more
    assert not does_more(views[0], views[0])


def test_each_mutant_is_another_model(examples: Path, tmp_path: Path) -> None:
    model = examples / "storage"
    made = list(mutants(system_of(model), model))
    before = {path.name: path.read_text(encoding="utf-8") for path in model.glob("*.swarm")}

    texts = set()
    for mutant in made:
        folder = mutant.write(model, tmp_path / "mutant")
        after = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.swarm")}
        assert sum(after[name] != before[name] for name in before) == 1
        texts.add(tuple(after.values()))

    assert len(texts) == len(made)
    kinds = {mutant.kind for mutant in made}
    assert kinds == {"no transition", "opposite guard", "other target", "no send"}
