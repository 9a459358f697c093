"""Page that plays a recording: one file, whose only script and style are its own."""

from __future__ import annotations

from base64 import b64encode
from hashlib import sha256
from html import escape
from pathlib import Path

from swarmdsl import __version__
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.read_files import read_text
from swarmdsl.tools.diagram.svg import style
from swarmdsl.tools.player.encoding import encode, pack
from swarmdsl.tools.player.modules import join
from swarmdsl.tools.player.recording import Recording

_OTHER = '<script type="application/octet-stream" id="other">{}</script>\n'
_CONNECT = "; connect-src 'self'"
_FILES = Path(__file__).resolve().parent / "page"


def page(recording: Recording, other: Recording | None = None) -> str:
    """Return the page of a recording as HTML; nothing of the recording is markup or script in it.

    It compares the run with the other one, if there is one.

    The policy lets nothing be loaded, and nothing run but the two scripts with these hashes: one
    unpacks the other. That of a live run also asks its server for lines.
    """
    is_fleet = "fleet" in recording.views
    script = join(_FILES, "fleet_page.js" if is_fleet else "main.js")
    loader = join(_FILES, "loader.js")
    left_out = {"player.css"} if is_fleet else {"player.css", "fleet.css"}
    sheets = sorted(each for each in _FILES.glob("*.css") if each.name not in left_out)
    styles = style() + "".join(map(read_text, (_FILES / "player.css", *sheets)))
    policy = (
        f"default-src 'none'; style-src {_hash(styles)}; script-src {_hash(loader)} "
        f"{_hash(script)}; base-uri 'none'; form-action 'none'"
        f"{_CONNECT if recording.live else ''}"
    )
    return read_text(_FILES / "index.html").format(
        policy=policy,
        version=__version__,
        title=escape(printable(recording.title)),
        style=styles,
        script=pack(script),
        loader=loader,
        recording=encode(recording),
        other="" if other is None else _OTHER.format(encode(other)),
    )


def _hash(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"
