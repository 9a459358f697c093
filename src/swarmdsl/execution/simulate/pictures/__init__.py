"""Pictures of a run: timelines and maps, standing and in motion, as SVG and pages.

In: lines of a trace, places of robots. Out: SVG, and a page that plays it. Read `timeline.py`
first, then `map_svg.py`.
"""
