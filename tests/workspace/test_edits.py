"""After any edit, a workspace says what a compiler says that reads all files for the first time."""

import random
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from shutil import copytree, ignore_patterns

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.source import Span
from swarmdsl.driver import pipeline
from swarmdsl.driver.workspace import Workspace
from swarmdsl.lowering import lower

ROOT = Path(__file__).resolve().parents[2]
SEEDS = 10
EDITS_A_MODEL = 20
_SNIPPETS = (
    *("event Late : std_msgs/Empty\n", "swarm event Far : geo_msgs/Fix\n"),
    *("const TOP : int32 = 4\n", "struct Pair { a : int32, b : Mode }\n"),
    *("enum Mode { ON, OFF }\n", "type Alias = Mode\n", "type Alias = Other\ntype Other = Alias\n"),
    *("const A : int32 = B\nconst B : int32 = A + 1\n", "message geo_msgs/Fix { lat : float64 }\n"),
    *("statemachine Sub { initial S; state S { } }\n", "member Extra { behavior Sub }\n"),
    *("package other\n", 'import "gone.swarm"\n', "import cpswarm.uav.*\n"),
    *("message std_msgs/Empty { x : int32 }\n", "sensor Eye extends Eye { }\n"),
    *("/* ", "*/", "{", "}"),
)
Edit = Callable[[str, random.Random], Iterator[str]]


def typed(text: str, dice: random.Random) -> Iterator[str]:
    """A line that is typed character by character."""
    lines = text.splitlines(keepends=True) or ["\n"]
    at = dice.randrange(len(lines))
    line = dice.choice([*lines, *_SNIPPETS]).rstrip("\n")
    for end in sorted(dice.sample(range(len(line) + 1), min(6, len(line) + 1))):
        yield "".join([*lines[:at], line[:end], "\n", *lines[at:]])


def rubbed_out(text: str, dice: random.Random) -> Iterator[str]:
    at = dice.randrange(len(text) + 1)
    for length in (1, 2, 5, 9):
        yield text[:at] + text[at + length :]


def line_deleted(text: str, dice: random.Random) -> Iterator[str]:
    lines = text.splitlines(keepends=True) or ["\n"]
    del lines[dice.randrange(len(lines))]
    yield "".join(lines)


def block_moved(text: str, dice: random.Random) -> Iterator[str]:
    blocks = re.split(r"(?<=\n)(?=\S)", text)
    block = blocks.pop(dice.randrange(len(blocks)))
    blocks.insert(dice.randrange(len(blocks) + 1), block)
    yield "".join(blocks)


def block_doubled(text: str, dice: random.Random) -> Iterator[str]:
    blocks = re.split(r"(?<=\n)(?=\S)", text)
    blocks.insert(dice.randrange(len(blocks) + 1), dice.choice(blocks))
    yield "".join(blocks)


def renamed(text: str, dice: random.Random) -> Iterator[str]:
    words = sorted(set(re.findall(r"[A-Za-z_]\w*", text))) or ["a"]
    old, new = dice.choice(words), dice.choice([*words, "fresh"])
    once = re.sub(rf"\b{old}\b", new, text, count=1)
    yield once
    yield re.sub(rf"\b{old}\b", new, text)


def word_replaced(text: str, dice: random.Random) -> Iterator[str]:
    words = list(re.finditer(r"\w+", text))
    if words:
        old, new = dice.choice(words), dice.choice(words)
        yield text[: old.start()] + new[0] + text[old.end() :]


def snippet_added(text: str, dice: random.Random) -> Iterator[str]:
    lines = text.splitlines(keepends=True)
    lines.insert(dice.randrange(len(lines) + 1), dice.choice(_SNIPPETS))
    yield "".join(lines)


def made_odd(text: str, dice: random.Random) -> Iterator[str]:
    at = dice.randrange(len(text) + 1)
    odd = dice.choice(["\x07", "é", "\u00a0", "“", '"', "\0", "///x\n", "\r\n", "<<<<<<< a\n"])
    yield text[:at] + odd + text[at:]


def emptied(_text: str, _dice: random.Random) -> Iterator[str]:
    yield ""


EDITS: list[Edit] = [
    *([typed] * 4 + [rubbed_out] * 2 + [line_deleted] * 2 + [block_moved] * 2 + [renamed] * 3),
    *([word_replaced] * 3 + [snippet_added] * 4 + [block_doubled, made_odd, emptied]),
]

LIBRARY = """\
package lib.parts
struct Mass { kilos : float64, unit : Mode }
enum Mode { LIGHT, HEAVY }
event Weighed : Mass
sensor Scale { out mass : Mass on "mass"; operation tare(out done : bool) }
statemachine Weigh {
  param limit : float64
  var mass : Mass
  initial Wait
  state Wait { on Weighed [event.kilos < limit] / mass = event -> Done }
  final Done
}
"""
USER = """\
package app
import "parts.swarm"
const LIMIT : float64 = 2.5 * BASE
const BASE : float64 = 4.0
type Load = Mass
swarm event Ready : Load
function lift : abstraction { action "lift" : app_msgs/Lift; param mass : float64 = 1.0 }
action app_msgs/Lift { goal { mass : float64 } }
statemachine Work {
  param limit : float64 = 1.0
  var count : int32 = 0
  var mode : Mode
  initial Idle
  state Idle { on Ready [event.kilos > LIMIT and mode == Mode.HEAVY] -> Check }
  state Check = Weigh(limit = limit) { on done -> Lift }
  state Lift {
    do lift(mass = limit)
    on succeeded / count = count + 1, send Ready(kilos = BASE) -> Tare
    on aborted -> Idle
  }
  state Tare { do scale.tare; on succeeded -> Idle; on aborted -> Lift }
}
member Carrier extends Cart {
  param limit : float64 = 2.0
  behavior Work
}
member Cart { scale : Scale }
swarm Site { carrier : Carrier[3]; fitness Yield }
swarm Yard { carrier : Carrier[2] }
fitness Yield { in loads : uint32 = total(carrier in Lift); maximize loads * 2 }
optimize Site { evaluations 10; carrier.limit in 1.0 .. 2.0 }
"""


def models() -> list[Path]:
    golden = (ROOT / "tests" / "golden").glob("*/model.swarm")
    return sorted([*(path.parent for path in golden), *(ROOT / "examples").glob("*/")])


def plain(found: Diagnostic) -> tuple[object, ...]:
    """A diagnostic without identities."""

    def place(span: Span) -> tuple[object, ...]:
        return span.source.name, span.start, span.end, span.source.line_column(span.start)

    return (
        found.primary and (*place(found.primary.span), found.primary.message),
        *(found.code, found.severity, found.message, found.notes, found.help),
        *((*place(label.span), label.message) for label in found.related),
    )


def edits(folder: Path, dice: random.Random) -> Iterator[dict[Path, str | None]]:
    """Edits of the files in a folder, one after the other: new texts, None for a deleted file."""
    originals = {
        path: path.read_text(encoding="utf-8")
        for path in sorted(folder.rglob("*"))
        if path.suffix in (".swarm", ".msg", ".srv", ".action")
    }
    texts: dict[Path, str | None] = dict(originals)
    while True:
        path = dice.choice(list(originals))
        text = texts[path]
        if text is None or dice.random() < 0.12:
            texts[path] = originals[path]
            yield {path: texts[path]}
        elif dice.random() < 0.03 and len(originals) > 1:
            texts[path] = None
            yield {path: None}
        else:
            for edited in dice.choice(EDITS)(text, dice):
                texts[path] = edited
                yield {path: edited}


@pytest.mark.parametrize("seed", range(SEEDS))
def test_edits(seed: int, tmp_path: Path, pytestconfig: pytest.Config) -> None:
    dice = random.Random(seed)
    wanted = pytestconfig.getoption("--mutants") // SEEDS
    places = models()
    done = 0
    while done < wanted:
        folder = tmp_path / str(done)
        if dice.random() < 0.4:
            folder.mkdir()
            (folder / "parts.swarm").write_text(LIBRARY, encoding="utf-8")
            (folder / "app.swarm").write_text(USER, encoding="utf-8")
        else:
            copytree(dice.choice(places), folder, ignore=ignore_patterns("expected*", "out"))
        workspace = Workspace([folder])
        history: list[str] = []
        for texts in edits(folder, dice):
            for path, text in texts.items():
                if text is None:
                    path.unlink()
                else:
                    path.write_bytes(text.encode())
                history.append(f"==== {path.name}\n{text}")
            from_disk = dice.random() < 0.5 or None in texts.values()
            workspace.update(dict.fromkeys(texts) if from_disk else texts)
            fresh = pipeline.check([folder])
            expected = list(map(plain, fresh.report))
            assert list(map(plain, workspace.report)) == expected, "\n".join(history[-2:])
            if fresh.valid is not None:
                assert lower(workspace.project) == fresh.system, "\n".join(history[-2:])
            done += 1
            if done % EDITS_A_MODEL == 0:
                break
