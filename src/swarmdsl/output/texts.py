"""The texts that were generated, by their hashes: what a merge begins with.

They are kept in one compressed file beside the manifest. A model of today does not say what a
model of yesterday was, nor does a generator, so that the text of yesterday cannot be made again.
The file may be missing, or be that of another state: a text is found by its hash or not at all.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterable
from functools import cached_property
from hashlib import sha256
from pathlib import Path

from swarmdsl.codegen.user_code_marks import mark_in
from swarmdsl.output.manifest import content_hash

NAME = ".swarmdsl.texts"


class Texts:
    """The texts of an output folder, read when one is asked for, and those that come to them."""

    def __init__(self, out: Path) -> None:
        self._file = out / NAME
        self._new: dict[str, str] = {}

    @cached_property
    def _stored(self) -> dict[str, str]:
        try:
            texts = json.loads(zlib.decompress(self._file.read_bytes()))
            return {hash_: text for hash_, text in texts.items() if isinstance(text, str)}
        except (OSError, ValueError, zlib.error, AttributeError, RecursionError):
            return {}

    def add(self, text: str) -> str:
        """Take up the text of a file, before there is anything of the user in it; its hash."""
        hash_ = content_hash(text.encode())
        self._new[hash_] = text
        return hash_

    def add_facts(self, facts: Iterable[str]) -> None:
        """Take up what code of the user builds on, which is found by its mark."""
        text = "\n".join(facts)
        self._new[sha256(text.encode()).hexdigest()] = text

    def get(self, hash_: str | None) -> bytes | None:
        """The text with this hash, None where it is not known."""
        if hash_ is None:
            return None
        text = self._new[hash_] if hash_ in self._new else self._stored.get(hash_)
        return text.encode() if text is not None else None

    def facts(self, mark: str) -> list[str] | None:
        """What code with this mark builds on."""
        for texts in (self._new, self._stored):
            for hash_, text in texts.items():
                if hash_.startswith(mark):
                    return text.splitlines()
        return None

    def knows(self, content: bytes) -> bool:
        """Whether this was generated, now or before, under whatever name."""
        hash_ = content_hash(content)
        return hash_ in self._new or hash_ in self._stored

    @property
    def missing(self) -> bool:
        """Whether there is no file of them."""
        return not self._file.exists()

    def packed(self, wanted: Iterable[str], marks: Iterable[str]) -> bytes | None:
        """Those with the hashes that are wanted, and facts with these marks or theirs, to store.

        The same bytes for the same texts; None where they are stored.
        """
        known = {**self._stored, **self._new}
        kept = {hash_: known[hash_] for hash_ in wanted if hash_ in known}
        of_texts = {mark for text in kept.values() if (mark := mark_in(text.encode()))}
        named = {*marks, *of_texts}
        kept |= {hash_: text for hash_, text in known.items() if hash_[:8] in named}
        if kept == self._stored:
            return None
        # At level 6 it takes four times as long, for a sixth less.
        return zlib.compress(json.dumps(kept, sort_keys=True).encode(), level=1)
