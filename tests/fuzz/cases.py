"""Random command lines with the files that they read, each known by its kind, seed and number."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from random import Random

import click

from swarmdsl.cli.commands import cli

from .mutations import NUMBERS, ODD, WORDS, mutated, mutated_json
from .odd_files import KINDS as ODD_KINDS
from .odd_files import odd_file
from .seeds import FILES

SIMULATE = "simulate --until 5s"
# The files that may have mistakes, by kind, and the commands that read them.
READERS = {
    "xml": {
        "machine.scxml": (
            "import scxml machine.scxml",
            "import scxml machine.scxml -o new.swarm",
            "import scxml machine.scxml -o model.swarm --dry-run",
            f"{SIMULATE} machine.scxml",
            "codegen --scxml machine.scxml -o made",
        ),
        "old.xml": (
            "import scxml old.xml --adf blink.json",
            "codegen --scxml old.xml --adf blink.json -o made",
        ),
        "lamp_msgs/package.xml": ("import ros lamp_msgs", "check model.swarm"),
    },
    "json": {
        "blink.json": (
            "import adf blink.json",
            "import amf blink.json",
            "import scxml old.xml --adf blink.json",
            "codegen --scxml old.xml --adf blink.json -o made",
        ),
        "events.jsonl": (
            f"{SIMULATE} model.swarm --machine Blinking --events events.jsonl",
            f"{SIMULATE} model.swarm --swarm Lamps --events events.jsonl",
            f"{SIMULATE} machine.scxml --events events.jsonl",
        ),
        "trace.jsonl": (
            f"{SIMULATE} model.swarm --machine Blinking --replay trace.jsonl",
            f"{SIMULATE} machine.scxml --replay trace.jsonl",
            "trace trace.jsonl",
        ),
    },
    "yaml": {
        "lamp_msgs/config/lamp.yaml": ("import ros lamp_msgs",) * 3,
        "lamp_msgs/msg/Level.msg": ("import ros lamp_msgs", "check model.swarm"),
        "lamp_msgs/srv/Ask.srv": ("import ros lamp_msgs", "check model.swarm"),
        "lamp_msgs/action/Blink.action": ("import ros lamp_msgs", "check model.swarm"),
    },
    "toml": {
        "swarm.toml": ("check", "build --dry-run", "fmt --check", "test", "add event New"),
        "scenario.toml": (f"{SIMULATE} --swarm Lamps --scenario scenario.toml",) * 2,
        "lamps.swarmtest.toml": ("test", "test lamps.swarmtest.toml --coverage"),
    },
}
WRITERS = (
    f"{SIMULATE} machine.scxml --trace-file {{}}",
    f"{SIMULATE} machine.scxml --timeline {{}}",
    "doc model.swarm -o {}",
    "diagram model.swarm -o {}",
    "diagram machine.scxml -o {}",
    "import scxml machine.scxml -o {}",
    "build model.swarm -o {}",
    "codegen --scxml old.xml -o {}",
    "test --junit {}",
    "new lamp --folder {}",
    "fmt {}",
    "merge {} model.swarm model.swarm -o {}",
    "diff {} model.swarm",
    "diff model.swarm {}",
    "diff --against {} model.swarm",
    "rename Go Start {}",
    "trace {} -o {}",
    "check {} model.swarm",
)
KINDS = ("files", *READERS, "arguments")
# They serve until they are stopped, or look at the machine.
_LEFT_OUT = ("lsp", "preview", "doctor")
_ENDLESS = ("--watch", "--real-time", "--follow")


@dataclass
class Case:
    """A command line in a folder with correct files but for these."""

    words: list[str]
    files: dict[str, bytes] = field(default_factory=dict)
    odd: dict[str, str] = field(default_factory=dict)

    def lay_out(self, folder: Path) -> None:
        """Write the files into an empty folder."""
        for name, content in {**_CORRECT, **self.files}.items():
            place = folder / name
            place.parent.mkdir(parents=True, exist_ok=True)
            if name not in self.odd:
                place.write_bytes(content)
        for name, kind in self.odd.items():
            made = odd_file(kind, folder / name)
            self.words = [str(made) if word == name else word for word in self.words]


_CORRECT = {name: text.encode() for name, text in FILES.items()}


def case(kind: str, seed: int, number: int) -> Case:
    """Return a case; the same arguments give the same one."""
    chance = Random(f"{kind} {seed} {number}")
    if kind == "files":
        return _odd_case(chance)
    if kind == "arguments":
        return Case(_arguments(chance))
    name = chance.choice(list(READERS[kind]))
    text = FILES[name]
    if name == "blink.json" and chance.random() < 0.6:
        content = mutated_json(text, chance)
    elif name.endswith(".jsonl") and chance.random() < 0.6:
        lines = text.splitlines()
        content = b"\n".join(mutated_json(chance.choice(lines), chance) for _ in lines)
    else:
        content = mutated(text, chance)
    return Case(chance.choice(READERS[kind][name]).split(), {name: content})


def _odd_case(chance: Random) -> Case:
    """Put an odd file in place of one that is read or written."""
    # The root folder is searched for some seconds.
    kind = chance.choice([each for each in ODD_KINDS if each != "the root folder"])
    if chance.random() < 0.3:
        place = chance.choice(("odd", "odd.swarm", "odd.svg", "odd.jsonl", "odd.scxml", "odd.html"))
        return Case(chance.choice(WRITERS).replace("{}", place).split(), odd={place: kind})
    readers = {name: each for of in READERS.values() for name, each in of.items()}
    readers["model.swarm"] = ("check model.swarm", "fmt model.swarm", "build", "doc", "diagram")
    name = chance.choice(list(readers))
    found = Case(chance.choice(readers[name]).split(), odd={name: kind})
    if chance.random() < 0.2:
        folder = chance.choice([each for each in FILES if not each.startswith(f"{name}/")])
        found.odd.setdefault(folder, kind)
    return found


def _arguments(chance: Random) -> list[str]:
    """Choose a command, and options of it with values of any kind."""
    words: list[str] = []
    command: click.Command = cli
    context = click.Context(cli)
    while isinstance(command, click.Group):
        names = [name for name in command.list_commands(context) if name not in _LEFT_OUT]
        words.append(chance.choice(names))
        found = command.get_command(context, words[-1])
        assert found is not None
        command = found
    options = [each for each in command.params if isinstance(each, click.Option)]
    for _ in range(chance.randrange(4)):
        if not options:
            break
        option = chance.choice(options)
        name = chance.choice(option.opts)
        if name not in _ENDLESS:
            words.append(name)
            if not option.is_flag and chance.random() < 0.95:
                choices = getattr(option.type, "choices", ())
                good = choices and chance.random() < 0.5
                words.append(chance.choice(list(choices)) if good else _value(chance))
    words += [_value(chance) for _ in range(chance.choice((0, 1, 1, 2, 3)))]
    if words[0] == "simulate":
        words += ["--until", "5s"]
    return words


def _value(chance: Random) -> str:
    chosen = chance.choice((*FILES, *FILES, "Go", "Blinking", "Lamps", "lamp", "a.b", "1s", "5"))
    if chance.random() < 0.5:
        chosen = chance.choice((*WORDS, *ODD, *NUMBERS))
    if chance.random() < 0.1:
        chosen = f"{chosen}{chance.choice((':', '=', '.', '/', ','))}{chance.choice(WORDS)}"
    # The system has no such arguments, and the case is to stay in its folder.
    chosen = chosen.replace("\0", "0").encode("utf-8", "replace").decode()
    return chosen if not chosen.startswith("/") or chosen.startswith("/dev/") else chosen.strip("/")
