"""Write all files that are made from the grammar: `make parser`."""

from __future__ import annotations

import sys

from swarmdsl.syntax.pegen.outputs import GrammarError, outputs


def main() -> int:
    """Write the files; return the exit code."""
    try:
        files, missing = outputs()
    except GrammarError as error:
        print(error, file=sys.stderr)  # noqa: T201
        print("Nothing was written.", file=sys.stderr)  # noqa: T201
        return 1
    for path, text in files.items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            print(f"wrote {path}")  # noqa: T201
    for message in missing:
        print(f"to do: {message}")  # noqa: T201
    return 0


if __name__ == "__main__":
    sys.exit(main())
