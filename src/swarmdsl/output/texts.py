"""Generated contents by hash: the common ancestors of merges.

They are kept in one compressed file beside the manifest, because the content of an earlier build
cannot be generated again from the current model. The file may be missing or outdated: lookups by
hash fail then.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterable
from functools import cached_property
from hashlib import sha256
from pathlib import Path

from swarmdsl.base.read_files import MOST_RECORDED, exists, read_file
from swarmdsl.codegen.user_code_marks import mark_in
from swarmdsl.output.manifest import content_hash

NAME = ".swarmdsl.texts"


class Texts:
    """Contents of an output folder, loaded on demand, and newly added ones."""

    def __init__(self, out: Path) -> None:
        self._file = out / NAME
        self._new: dict[str, str] = {}

    @cached_property
    def _stored(self) -> dict[str, str]:
        try:
            texts = json.loads(zlib.decompress(read_file(self._file, MOST_RECORDED)))
            return {hash_: text for hash_, text in texts.items() if isinstance(text, str)}
        except (OSError, ValueError, zlib.error, AttributeError, RecursionError):
            return {}

    def add(self, text: str) -> str:
        """Add the content of a file, without user edits; return its hash."""
        hash_ = content_hash(text.encode())
        self._new[hash_] = text
        return hash_

    def add_facts(self, facts: Iterable[str]) -> None:
        """Add the facts that code of the user builds on; their mark is the key."""
        text = "\n".join(facts)
        self._new[sha256(text.encode()).hexdigest()] = text

    def get(self, hash_: str | None) -> bytes | None:
        """Return the content with a hash, None if unknown."""
        if hash_ is None:
            return None
        text = self._new[hash_] if hash_ in self._new else self._stored.get(hash_)
        return text.encode() if text is not None else None

    def facts(self, mark: str) -> list[str] | None:
        """Return the facts with a mark."""
        for texts in (self._new, self._stored):
            for hash_, text in texts.items():
                if hash_.startswith(mark):
                    return text.splitlines()
        return None

    def knows(self, content: bytes) -> bool:
        """Return True if the content was generated now or before, under any name."""
        hash_ = content_hash(content)
        return hash_ in self._new or hash_ in self._stored

    @property
    def missing(self) -> bool:
        """True if there is no file of them."""
        return not exists(self._file)

    def packed(self, wanted: Iterable[str], marks: Iterable[str]) -> bytes | None:
        """Pack the contents with the given hashes, and the facts with their marks.

        Deterministic. None if they are already stored.
        """
        known = {**self._stored, **self._new}
        kept = {hash_: known[hash_] for hash_ in wanted if hash_ in known}
        of_texts = {mark for text in kept.values() if (mark := mark_in(text.encode()))}
        named = {*marks, *of_texts}
        kept |= {hash_: text for hash_, text in known.items() if hash_[:8] in named}
        if kept == self._stored:
            return None
        # Level 6 takes four times as long and saves a sixth.
        return zlib.compress(json.dumps(kept, sort_keys=True).encode(), level=1)
