"""Tests claim properties of the model, or that a fault breaks them."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import MODEL, Ran

PROPERTIES = """
property Dark of Lamps : never count(lamp in Bright) > 2
property Lit of Lamps : after Start, some lamp in On within 1 s
property Out of Lamps : each lamp : eventually in Gone
property Off of Blinking : in Off at all times
"""
MEANWHILE = 'meanwhile = [{ pass = "4 s" }, { send = "Start" }]'
Run = Callable[..., Ran]


@pytest.fixture
def run(folder: Path, ran: Run) -> Run:
    """Run tests of the model with properties."""
    (folder / "lamps.swarm").write_text(MODEL + PROPERTIES, encoding="utf-8")
    return ran


def test_a_property_that_is_violated_fails_a_test(run: Run) -> None:
    test = '[[test]]\nname = "t"\nproperties = ["Dark"]\nsteps = [{ send = "Start" }]\n'
    ran = run(f'swarm = "Lamps"\n{test}')
    assert ran.code == 1
    assert "error[SW1606]: property `Dark` is violated at 0 ms" in ran.out + ran.err
    assert 'properties = ["Dark"]' in ran.out + ran.err


def test_all_properties_but_one_that_the_test_breaks(run: Run) -> None:
    test = '[[test]]\nname = "t"\nviolates = ["Dark"]\nsteps = [{ send = "Start" }]\n'
    assert run(f'swarm = "Lamps"\nproperties = "all"\n{test}').code == 0


def test_a_property_that_is_open_fails_no_test(run: Run) -> None:
    test = '[[test]]\nname = "t"\nproperties = "Out"\nsteps = [{ pass = "1 min" }]\n'
    assert run(f'swarm = "Lamps"\n{test}').code == 0


@pytest.mark.parametrize(
    ("steps", "failed"),
    [
        # Machines that have just started owe something, some of them for ever.
        ('{ no = "lamp", satisfies = "Out" }, { satisfies = "Lit" }', ""),
        ('{ all = "lamp", satisfies = "Out", within = "1 min" }', "`lamp[0]`"),
        ('{ satisfies = "Out" }', "to satisfy `Out`"),
        ('{ who = "lamp[1]", satisfies = "Out", for = "1 s" }', "`lamp[1]` leaves `Out` open"),
        ('{ send = "Start" }, { satisfies = "Dark" }', "its verdict is false"),
        ('{ satisfies = "Rings" }', "its verdict is open"),
        ('{ satisfies = "Rings", within = "9 s", meanwhile = [{ pass = "1 s" }] }', "after 9 s"),
        (
            f'{{ satisfies = "Rings", within = "9 s", {MEANWHILE} }}, {{ satisfies = "Rings" }}',
            "",
        ),
    ],
)
def test_a_claim_that_a_property_is_true(run: Run, folder: Path, steps: str, failed: str) -> None:
    rings = "property Rings of Lamps : eventually some lamp in On\n"
    (folder / "lamps.swarm").write_text(MODEL + PROPERTIES + rings, encoding="utf-8")
    ran = run(f'swarm = "Lamps"\n[[test]]\nname = "t"\nsteps = [{steps}]\n')
    assert ran.code == bool(failed), ran.out + ran.err
    assert failed in ran.out + ran.err


@pytest.mark.parametrize(
    ("step", "code", "told"),
    [
        ('{ satisfies = "Drk" }', "SW0202", "did you mean `Dark`?"),
        ('{ satisfies = "Off" }', "SW0202", "no property called `Off`"),
        ("{ satisfies = 3 }", "SW0013", ""),
        ('{ who = "lamp", satisfies = "Dark" }', "SW1103", "leave out the robots"),
        ('{ count = 0, satisfies = "Dark" }', "SW1103", "leave out the robots"),
        ('{ who = "spare", satisfies = "Out" }', "SW1103", "`Out` is about each `lamp`"),
        ('{ satisfies = "Out", in = "Off" }', "SW1103", "cannot be combined"),
        (
            '{ satisfies = "Lit", meanwhile = [{ pass = "1 s" }] }',
            "SW1103",
            "`meanwhile` requires `within`",
        ),
        (
            '{ satisfies = "Lit", within = "1 s", meanwhile = [{ pass = "0 s" }] }',
            "SW1103",
            "no time passes `meanwhile`",
        ),
        (
            '{ satisfies = "Lit", within = "1 s", meanwhile = [{ wait = "1 s" }] }',
            "SW0012",
            "write `pass`",
        ),
        ('{ satisfies = "Lit", within = "1 s", meanwhile = [{}] }', "SW0013", "takes"),
        ('{ satisfies = "Lit", within = "1 s", meanwhile = 3 }', "SW0013", "takes tables"),
        ('{ pass = "1 s", meanwhile = [{ pass = "1 s" }] }', "SW0012", "the keys are `pass`"),
    ],
)
def test_claims_about_properties_that_make_no_sense(
    run: Run, step: str, code: str, told: str
) -> None:
    ran = run(f'swarm = "Lamps"\n[[test]]\nname = "t"\nsteps = [{step}]\n')
    assert ran.code == 1
    assert re.findall(r"^error\[(\w+)\]", ran.out + ran.err, re.MULTILINE) == [code]
    assert told in ran.out + ran.err


def test_a_property_that_holds_is_not_violated(run: Run) -> None:
    test = '[[test]]\nname = "t"\nviolates = "Lit"\nsteps = [{ send = "Start" }]\n'
    ran = run(f'swarm = "Lamps"\n{test}')
    assert ran.code == 1
    assert "expected property `Lit` to be violated" in ran.out + ran.err
    assert "its verdict is true" in ran.out + ran.err


@pytest.mark.parametrize(
    ("steps", "noted"),
    [
        ('{ pass = "1 s" }', ["scope never began", "first part never happened"]),
        ('{ send = "Start" }, { pass = "1 s" }', []),
    ],
)
def test_a_property_that_says_nothing_of_any_test_is_noted(
    run: Run, folder: Path, steps: str, noted: list[str]
) -> None:
    quiet = "property Lights of Lamps : some lamp in On leads to some lamp in Off\n"
    (folder / "lamps.swarm").write_text(MODEL + PROPERTIES + quiet, encoding="utf-8")
    waits = '[[test]]\nname = "waits"\nsteps = [{ pass = "1 s" }]\n'
    test = f'[[test]]\nname = "t"\nsteps = [{steps}]\n'
    ran = run(
        f'swarm = "Lamps"\nproperties = ["Lit", "Lights"]\n{waits}{test}', "--junit", "out.xml"
    )
    assert ran.code == 0
    assert re.findall(r"  note    property `\w+`: its (.*) in these tests", ran.out) == noted
    assert all(remark in Path("out.xml").read_text(encoding="utf-8") for remark in noted)


def test_properties_of_a_file_are_those_of_the_subject(run: Run) -> None:
    test = '[[test]]\nname = "t"\nmachine = "Blinking"\nsteps = [{ send = "Start" }]\n'
    ran = run(f'properties = ["Dark", "Off"]\n{test}')
    assert ran.code == 1
    assert "property `Off` is violated" in ran.out + ran.err
    assert run(f'properties = ["Dark"]\n{test}').code == 0


def test_an_unknown_property_is_reported(run: Run) -> None:
    test = '[[test]]\nname = "t"\nproperties = ["Drk"]\nsteps = [{ send = "Start" }]\n'
    ran = run(f'swarm = "Lamps"\n{test}')
    assert ran.code == 1
    assert "error[SW0202]: no property called `Drk`" in ran.out + ran.err
    assert "did you mean `Dark`?" in ran.out + ran.err


def test_sarif_is_one_document(run: Run) -> None:
    test = '[[test]]\nname = "{0}"\nproperties = "{0}"\nsteps = [{{ send = "Start" }}]\n'
    both = test.format("Dark") + test.format("all").replace('"Start"', '"Alarm"')
    ran = run(f'swarm = "Lamps"\n{both}', "--format", "sarif")
    (log,) = json.loads(ran.out)["runs"]
    assert [each["ruleId"] for each in log["results"]] == ["SW0202", "SW1606"]
    assert "1 failed" in ran.err
