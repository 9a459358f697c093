"""The manifest of a package: package.xml (REP 140 for ROS 1, REP 149 for ROS 2)."""

from __future__ import annotations

from collections.abc import Iterable

from lxml import etree

from .options import Options

FORMATS = {1: "2", 2: "3"}


def manifest(
    name: str,
    doc: str,
    depends: Iterable[tuple[str, str]],
    options: Options,
    exports: Iterable[tuple[str, str]] = (),
    region: str = "",
) -> str:
    """Its text: each dependency with its tag; a region of the user's if that has a name."""
    root = etree.Element("package", format=FORMATS[options.ros])
    if region:
        root.append(etree.Comment(" Lines between the two marks below are yours. "))
    _child(root, "name", name)
    _child(root, "version", options.version)
    _child(root, "description", " ".join(doc.split()))
    _child(root, "maintainer", options.maintainer, email=options.email)
    _child(root, "license", options.license)
    for tag, package in depends:
        _child(root, tag, package)
    if region:
        root.append(etree.Comment(f" swarmc:begin {region} "))
        root.append(etree.Comment(f" swarmc:end {region} "))
    if exports:
        export = etree.SubElement(root, "export")
        for tag, text in exports:
            _child(export, tag, text)
    text = etree.tostring(root, pretty_print=True, encoding="unicode")
    return f'<?xml version="1.0"?>\n{text}'


def _child(parent: etree._Element, tag: str, text: str, **attributes: str) -> None:
    child = etree.SubElement(parent, tag, attributes)
    child.text = text
