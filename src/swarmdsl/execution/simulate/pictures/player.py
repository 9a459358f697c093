"""Page that plays an animation: one file without a network, whose only script is its own."""

from __future__ import annotations

from base64 import b64encode
from hashlib import sha256
from pathlib import Path

from swarmdsl.base.read_files import read_file
from swarmdsl.execution.simulate.pictures.map_animation import Timing
from swarmdsl.execution.simulate.pictures.map_svg import plain_text

_FILES = Path(__file__).resolve().parent / "page"
_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
{svg}<div id="controls" data-period="{period:.6g}" data-run="{run:.6g}" hidden>
<button id="play" type="button" title="Play or pause (space)">Pause</button>
<input id="time" type="range" min="0" step="any" value="0" aria-label="Time of the run">
<span id="clock"></span>
<select id="rate" aria-label="Speed">
<option value="0.25">slow</option>
<option value="1" selected>normal</option>
<option value="4">fast</option>
</select>
</div>
<script>{script}</script>
</body>
</html>
"""


def player(title: str, svg: str, timing: Timing) -> str:
    """Return a page with a picture that moves; without scripts, it plays by itself."""
    script = _read("player.js")
    digest = b64encode(sha256(script.encode()).digest()).decode()
    policy = (
        f"default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{digest}'; "
        "base-uri 'none'; form-action 'none'"
    )
    return _PAGE.format(
        policy=policy,
        title=plain_text(title),
        style=_read("player.css"),
        svg=svg,
        period=timing.period,
        run=timing.run,
        script=script,
    )


def _read(name: str) -> str:
    return read_file(_FILES / name).decode()
