"""Tables of the interfaces of a node, for the README of its package."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen import cell, code_cell, dataclass

from .nodes import Node, Topic
from .view import NodeView


@dataclass(frozen=True)
class Table:
    """A table of a README with at least one row of cells."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def tables(node: Node, view: NodeView) -> tuple[Table, ...]:
    """Return the tables of servers, topics and ROS parameters of a node."""
    found = (
        Table(
            "Servers",
            ("name", "type", ""),
            tuple(
                (code_cell(each.name), code_cell(f"{each.type} ({each.paradigm})"), cell(each.doc))
                for each in node.servers
            ),
        ),
        Table("Subscribed topics", ("name", "type", ""), tuple(_topics(node.inputs))),
        Table("Published topics", ("name", "type", ""), tuple(_topics(node.outputs))),
        Table(
            "ROS parameters",
            ("name", "type", "default", ""),
            tuple(
                (code_cell(each.name), each.said, code_cell(each.yaml), cell(setting.doc))
                for each, setting in zip(view.settings, node.settings, strict=True)
            ),
        ),
    )
    return tuple(table for table in found if table.rows)


def _topics(topics: tuple[Topic, ...]) -> Iterator[tuple[str, ...]]:
    for each in topics:
        yield code_cell(each.topic), code_cell(str(each.type)), cell(each.doc)
