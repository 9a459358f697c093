"""Compositions of swarms by the modelling tool's schema, and their launch files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator
from swarmdsl.codegen.exchange import composition
from swarmdsl.ir import System

Compile = Callable[[str], System]

MODEL = """
statemachine Look {
  param wait  : duration
  param name  : string<=9
  param tries : uint8 = 3
  param loud  : bool
  initial A
  state A { after wait -> B }
  final B
}
sensor Eye {
  behavior Look
  param wait  : duration   = 2 s
  param name  : string<=9  = "eye"
  param tries : uint8      = 2 + 2
  param loud  : bool       = false
}
member Uav {
  behavior Look
  param wait : duration = 1500 ms
  param name : string<=9 = "<uav>"
  param loud : bool = true
  left : Eye { wait = 0.5 s }
}
member Stone { }
/// All of them.
swarm Search {
  /// A & B.
  uav  : Uav[3]
  some : Stone[2..*]
  any  : Stone[*]
}
"""


def emitted(system: System, package: str = "") -> tuple[dict[str, str], Diagnostics]:
    report = Diagnostics()
    files = composition.emit(system, composition.Options(package), report)
    return {file.path: file.text for file in files}, report


def test_members(compiled: Compile) -> None:
    files, report = emitted(compiled(MODEL))

    assert list(files) == [
        "search/composition.xml",
        "search/launch/uav.launch",
        "search/launch/some.launch",
        "search/launch/any.launch",
    ]
    assert files["search/composition.xml"].splitlines() == [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<swarm name="Search">',
        "  <!-- All of them. -->",
        '  <SwarmMember name="uav" launchFile="uav.launch" number="3">A &amp; B.</SwarmMember>',
        '  <SwarmMember name="some" launchFile="some.launch" number="2"/>',
        '  <SwarmMember name="any" launchFile="any.launch" number="1"/>',
        "</swarm>",
    ]
    assert [(found.name, found.message) for found in report] == [
        ("no-place", "target `composition` cannot represent multiplicity `2..*`"),
        ("no-place", "target `composition` cannot represent multiplicity `*`"),
    ]


def test_a_launch_file_starts_one_member(compiled: Compile) -> None:
    files, _ = emitted(compiled(MODEL))
    launch = etree.fromstring(files["search/launch/uav.launch"].encode())
    nodes = {node.get("name"): node for node in launch.iter("node")}
    params = {
        name: {p.get("name"): (p.get("type"), p.get("value")) for p in node}
        for name, node in nodes.items()
    }

    assert [group.get("ns") for group in launch.iter("group")] == ["uav_$(arg id)"]
    assert params == {
        "look": {
            "wait": ("double", "1.5"),
            "name": ("str", "<uav>"),
            "tries": ("int", "3"),
            "loud": ("bool", "true"),
        },
        "left": {
            "wait": ("double", "0.5"),
            "name": ("str", "eye"),
            "tries": ("int", "4"),
            "loud": ("bool", "false"),
        },
    }
    assert {(node.get("pkg"), node.get("type")) for node in nodes.values()} == {
        ("test_behavior", "look")
    }


def test_the_nodes_are_those_of_target_smach(search_and_rescue: System) -> None:
    smach = registry.load("smach")
    assert isinstance(smach, Generator)
    there = {
        file.path for file in smach.emit(search_and_rescue, smach.options_type(), Diagnostics())
    }
    files, _ = emitted(search_and_rescue)
    named = {
        f"{node.get('pkg')}/scripts/{node.get('type')}"
        for path, text in files.items()
        if path.endswith(".launch")
        for node in etree.fromstring(text.encode()).iter("node")
    }

    assert len(named) == 2
    assert named <= there


def test_the_package_can_be_another(compiled: Compile) -> None:
    files, _ = emitted(compiled(MODEL), package="mine")

    assert 'pkg="mine"' in files["search/launch/uav.launch"]


def test_a_text_that_roslaunch_would_replace(compiled: Compile) -> None:
    files, report = emitted(compiled(MODEL.replace('"<uav>"', '"$(env A)"')))
    tree = etree.fromstring(files["search/launch/uav.launch"].encode())

    assert '"$(env A)"' not in [found.primary.span.text for found in report if found.primary]
    # YAML without substitutions.
    assert [each.text for each in tree.iter("rosparam")] == ['"$(env A)"']


def test_the_schema_of_the_modelling_tool(compiled: Compile, corpus: Path, tmp_path: Path) -> None:
    # It declares types, and no element of them.
    types = (corpus / "schema" / "2021_SwarmComposition.xsd").as_uri()
    path = tmp_path / "schema.xsd"
    path.write_text(
        f"""
        <xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="qualified">
          <xs:include schemaLocation="{types}"/>
          <xs:element name="swarm" type="Swarm"/>
        </xs:schema>
        """,
        encoding="utf-8",
    )
    schema = etree.XMLSchema(etree.parse(path))
    files, _ = emitted(compiled(MODEL))
    tree = etree.fromstring(files["search/composition.xml"].encode())

    assert schema.validate(tree), schema.error_log
    del tree[1].attrib["launchFile"]
    assert not schema.validate(tree)
