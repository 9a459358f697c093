"""Words of the space that no declaration has: settings of robots and sensors, models of functions.

They are completed, and described on hover.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.source import Span
from swarmdsl.ide.server.speculative_parse import PLACEHOLDER
from swarmdsl.ir.function_models import MODELS
from swarmdsl.ir.space_settings import SPACE_SETTINGS, SpaceSetting
from swarmdsl.syntax.ast import Equipment, ModelUse, PartValue, Sight, TopLevel, nodes_of


def words_at(owner: TopLevel) -> list[tuple[str, str, str]] | None:
    """Return the words in place of the placeholder, with a detail and a text to insert.

    None if it stands for something else.
    """
    for kind, values in _blocks(owner):
        names = [str(value.name) for value in values]
        if PLACEHOLDER in names:
            left = [each for name, each in SPACE_SETTINGS[kind].items() if name not in names]
            return [(each.name, _detail(each), f"{each.name} = ${{1}}") for each in left]
    for use in nodes_of(owner, ModelUse):
        if use.name == PLACEHOLDER:
            return [(each.name, "model", each.name) for each in MODELS.values()]
        given = [str(argument.name) for argument in use.arguments]
        if PLACEHOLDER in given:
            model = MODELS.get(str(use.name))
            return [
                (each.name, f"argument : {each.kind}", f"{each.name} = ${{1}}")
                for each in (model.arguments if model is not None else ())
                if each.name not in given
            ]
    return None


def described_word(owner: TopLevel, offset: int) -> tuple[Span, str] | None:
    """Return the setting, model or argument at an offset, and its Markdown."""
    for span, text in _described(owner):
        found = span.absolute
        if found.start <= offset <= found.end:
            return found, text
    return None


def _described(owner: TopLevel) -> Iterator[tuple[Span, str]]:
    for kind, values in _blocks(owner):
        for value in values:
            setting = SPACE_SETTINGS[kind].get(str(value.name))
            if setting is not None:
                yield value.name.span, f"{_detail(setting)} of `{kind}`\n\n{setting.doc}"
    for use in nodes_of(owner, ModelUse):
        model = MODELS.get(str(use.name))
        if model is not None:
            arguments = ", ".join(each.name for each in model.arguments)
            head = f"```swarm\nmodel {model.name}({arguments})\n```"
            yield use.name.span, f"{head}\n\n{model.doc}"
            for given in use.arguments:
                argument = model.argument(str(given.name))
                if argument is not None:
                    text = f"argument : {argument.kind} of `{model.name}`\n\n{argument.doc}"
                    yield given.name.span, text


def _blocks(owner: TopLevel) -> Iterator[tuple[str, list[PartValue]]]:
    yield from ((each.kind, each.values) for each in nodes_of(owner, Equipment))
    yield from (("senses", each.values) for each in nodes_of(owner, Sight))


def _detail(setting: SpaceSetting) -> str:
    unit = f" in {setting.unit}" if setting.unit else ""
    return f"setting : float64{unit}"
