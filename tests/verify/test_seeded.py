"""Seeded mistakes in an example: what `swarmc verify` says of some of them."""

from __future__ import annotations

from pathlib import Path

from .mutants import mutants
from .seeded import Case, Original, system_of

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
    original = Original(examples / "emergency_exit", "Crowd", WALKS)
    found: dict[tuple[str, str], Case] = {}
    for mutant in original.mutants():
        what = (mutant.kind, mutant.place.text)
        if what in FATES and what not in found:
            found[what] = original.judge(mutant, tmp_path / "mutant")

    assert original.alarms == set()
    assert {what: case.fate for what, case in found.items()} == FATES


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
