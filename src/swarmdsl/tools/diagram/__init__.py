"""Draw diagrams of swarms, members and state machines: `swarmc diagram`.

The graph of a diagram comes from `codegen.diagram` and is written in one of the formats; SVG needs
a layout first.
"""
