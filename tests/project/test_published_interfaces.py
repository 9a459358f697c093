"""Libraries of packages of today declare the interfaces that these packages publish."""

from __future__ import annotations

import re

import pytest
import tomli

from swarmdsl.base import resources

from . import catalogue
from .published_interfaces import ABOUT, RECORDS, outline, shipped

PUBLISHED = {
    path.stem: tomli.loads(path.read_text(encoding="utf-8")) for path in RECORDS.glob("*.toml")
}
OF_TODAY = [name for name in catalogue.PACKAGES if not name.startswith("cpswarm")]


def test_each_record_says_where_it_is_from() -> None:
    for package, of in PUBLISHED.items():
        assert all(of.get(key) for key in ABOUT), package
        assert re.fullmatch(r"[0-9a-f]{40}", of["commit"]), package
        assert re.fullmatch(r"20\d\d-\d\d-\d\d", of["date"]), package


@pytest.mark.parametrize("library", OF_TODAY)
def test_interfaces_are_those_that_are_published(library: str) -> None:
    compared = set()
    for package, kind, name, declared in shipped(library):
        published = PUBLISHED[package][kind][name]
        assert outline(declared) == published, f"{package}/{name}"
        compared.add((package, kind, name))

    packages = {package for package, _, _ in compared}
    recorded = {
        (package, kind, name)
        for package in packages
        for kind in ("msg", "srv", "action")
        for name in PUBLISHED[package].get(kind, ())
    }
    assert recorded == compared


@pytest.mark.parametrize("library", OF_TODAY)
def test_interface_files_name_package_version_distribution_and_date(library: str) -> None:
    """The text above the declarations says which publication they are of."""
    packages = {package for package, _, _, _ in shipped(library)}
    files = [*(resources.library() / library).rglob("interfaces*")]
    heads = " ".join(
        re.sub(r"\n/// ?", " ", path.read_text(encoding="utf-8").partition("\npackage ")[0])
        for path in files
    )
    for package in packages:
        of = PUBLISHED[package]
        for word in (package, of["version"], of["distribution"], of["date"]):
            assert word.lower() in heads.lower(), f"{package}: {word}"


def test_no_record_is_of_nothing() -> None:
    used = {package for library in OF_TODAY for package, _, _, _ in shipped(library)}
    assert set(PUBLISHED) == used
