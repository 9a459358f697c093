"""A model with strings and documentation at every place that reaches generated files."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from pathlib import Path

from swarmdsl.syntax.parser.literals import quoted

# What ends a line, a string, a comment or a section in some format, or is evaluated in one.
HOSTILE = (
    "a\u2028b",
    "a\u2029b",
    "a\x85b",
    "</script><script>alert(1)</script>",
    "a\tb",
    "a\nb",
    "\nb\n",
    "a\rb",
    "a\r\nb",
    "what??/",
    "??(x??)",
    'three""" quotes',
    "three''' quotes",
    "*/ int x; /*",
    "// /* x",
    "a -- b",
    "--> <x/> <!--",
    "]]> <![CDATA[ x ]]>",
    "<?x ?>",
    "$(eval 1 + 1)",
    "$(find x) $(arg x) $(env HOME)",
    "$HOME ${HOME} `id` $(id)",
    "{{ 1 + 1 }} {% raw %} {# x #}",
    "%s %d %n %%",
    "backslash \\",
    "\\",
    "\\n \\u0041 \\x41 \\101 \\N{DIGIT ONE}",
    "robot \U0001f916",
    "accent \u00e9 e\u0301",
    "right to left \u202e",
    "no space \u200b\ufeff",
    "\x7f\x80\x9f",
    'one " quote',
    "one ' quote",
    "'",
    '"',
    "\"'",
    "& &amp; &#10; <b>",
    "# hash",
    "- yes",
    "[1, 2]",
    "{a: 1}",
    "true",
    "null",
    "~",
    "1e3",
    "0x10",
    "2026-11-23",
    "!!python/object:os.system",
    "&a *a",
    "a: b",
    "|",
    "@x %x",
    " blank ",
    "   ",
    "=x",
    "coding: utf-7",
    "swarmc:begin x",
    "[x](javascript:alert(1)) ![x](x)",
    "```",
    "| cell |",
    "",
)
# A comment ends with its line, and a file has no control characters.
DOCS = tuple(text for text in HOSTILE if text.strip() and not re.search("[\n\r\x7f-\x9f]", text))
# What could reach beyond the end of a comment or documentation string.
ENDS = ("backslash \\", "what??/", '"')

Place = tuple[str, int]
"""The name of a place in the model, and the number of a string there."""

_TEMPLATE = (Path(__file__).parent / "hostile.swarm.txt").read_text(encoding="utf-8")


def model(
    strings: Sequence[str], doc: str, left_out: Collection[Place] = (), worlds: bool = False
) -> str:
    """Return a model with each string at each place, and documentation at each place."""
    lines = []
    for line in _TEMPLATE.splitlines():
        if line.strip() == "/// DOC":
            lines += [f"/// {text}" for text in doc.split("\n")]
        elif line.startswith("@ "):
            place, _, written = line.removeprefix("@ ").partition(" | ")
            if place in ("world", "swarm") and not worlds:
                continue
            for number, text in enumerate(strings):
                if (place, number) not in left_out:
                    made = written.replace("$n", str(number)).replace("$s", quoted(text))
                    lines += [*(f"/// {each}" for each in doc.split("\n")), f"{made} // {place}"]
                    lines[-1] += f" {number}"
        else:
            lines.append(line)
    return "".join(f"{line}\n" for line in lines)


def place_of(line: str) -> Place | None:
    """Return the place of a line of the model, None without a string."""
    _, mark, written = line.rpartition(" // ")
    place, _, number = written.rpartition(" ")
    return (place, int(number)) if mark and number.isdigit() else None


def placeholders(strings: Sequence[str]) -> list[str]:
    """Return harmless strings, as long as their literals, so that lines break alike."""
    return [f"P{number:03}L".ljust(len(repr(text)) - 2, "x") for number, text in enumerate(strings)]


def replaced(text: str, strings: Sequence[str]) -> str:
    """Replace the placeholders by the strings."""
    return re.sub(r"P(\d{3})Lx*", lambda found: strings[int(found[1])], text)
