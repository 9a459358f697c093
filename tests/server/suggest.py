"""List of completions as VS Code keeps it while a user types."""

from __future__ import annotations

import re

from lsprotocol import types as lsp

from .editor import position

_CLIENT = lsp.CompletionTriggerKind


class Suggest:
    """Types at the end of a text, and keeps the list as `SuggestModel` of VS Code does.

    A word that begins while the list is open is looked for in the list: the server is not asked
    again. So an item that matches a keyword with a blank after it hides the names that follow.
    """

    def __init__(self, client, editor, document, before, after):
        self._client, self._editor, self._document = client, editor, document
        self._text, self._after = before, after
        self._items = []

    async def type(self, text):
        """Type a text; return the matching items, in order."""
        triggers = self._client.offered.completion_provider.trigger_characters
        for char in text:
            self._text += char
            self._items = self.matching()
            self._editor.type(self._document, self._text + self._after)
            if char in triggers:
                await self._ask(_CLIENT.TriggerCharacter, char)
            elif not self._items and re.search(r"(?<!\w)[A-Za-z_]\Z", self._text):
                await self._ask(_CLIENT.Invoked)
        return [item for item, _ in self.matching()]

    def matching(self):
        """Return the items that match what is typed, with the offsets of what they replace."""
        found = []
        for item, start in self._items:
            typed = self._text[start:]
            score = _score(typed, item.filter_text or item.label)
            if score is not None:
                found.append((-score, item.sort_text, start, item))
        found.sort(key=lambda each: each[:3])
        return [(item, start) for _, _, start, item in found]

    async def _ask(self, kind, char=None):
        found = await self._client.text_document_completion_async(
            lsp.CompletionParams(
                text_document=self._document,
                position=position(self._text, len(self._text)),
                context=lsp.CompletionContext(trigger_kind=kind, trigger_character=char),
            )
        )
        self._items = [(item, self._start(item)) for item in found]

    def _start(self, item):
        """Return the offset of what an item replaces: the word before the cursor, or its range."""
        if item.text_edit is None:
            return len(re.sub(r"\w+\Z", "", self._text))
        line = len(self._text) - len(self._text.rpartition("\n")[2])
        return line + item.text_edit.range.start.character


def _score(typed, word):
    """Return a rough score as the fuzzy one of VS Code; None if the word does not match."""
    if word.startswith(typed):
        return 3 + (word == typed)
    if word.lower().startswith(typed.lower()):
        return 2
    letters = iter(word.lower())
    return 1 if all(letter in letters for letter in typed.lower()) else None
