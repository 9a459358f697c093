"""Generate source text of a given length in other languages."""

from __future__ import annotations

from collections.abc import Callable

_PROTO = """
// What robot {n} tells of its search.
message Finding{n} {{
  string id = 1;
  double weight = 2;
  repeated double place = 3;
  Mode{n} mode = 4;
  map<string, int32> seen = 5;
}}

enum Mode{n} {{
  IDLE{n} = 0;
  BUSY{n} = 1;
  FAULT{n} = 2;
}}

message Work{n} {{
  double distance = 1;
  Finding{n} found = 2;
  oneof end {{
    string reason = 3;
    int32 code = 4;
  }}
}}

service Robot{n} {{
  rpc Search(Work{n}) returns (stream Finding{n});
  rpc Charge(Finding{n}) returns (Work{n});
}}
"""

_SQL = """
-- What robot {n} has found.
CREATE TABLE finding_{n} (
  id VARCHAR(40) PRIMARY KEY,
  weight DOUBLE NOT NULL,
  tries INTEGER DEFAULT 0
);

SELECT f.id,
  f.weight * 2.0 AS heavy,
  COUNT(*) AS many
FROM finding_{n} AS f
WHERE f.tries < 3 AND f.weight > 0.5
GROUP BY f.id, f.weight
ORDER BY many DESC;

UPDATE finding_{n}
SET tries = tries + 1
WHERE id = 'last';
"""

_PYTHON = '''
class Robot{n}:
    """Searches, and goes back to what was found."""

    limit: int = {n}

    def search(self, distance: float, tries: int = 0) -> str:
        """The outcome of a search."""
        while tries < self.limit and distance > 0.5:
            tries = tries + 1
            if self.found(distance * 2.0):
                return "succeeded"
        return "aborted"

    def found(self, distance: float) -> bool:
        place = self.places.get(distance)
        return place is not None and not place.empty
'''

_TYPESPEC = """
/** What robot {n} tells of its search. */
model Finding{n} {{
  id: string;
  weight: float64;
  place: float64[];
  mode?: Mode{n};
}}

enum Mode{n} {{
  IDLE,
  BUSY,
  FAULT,
}}

model Work{n} extends Finding{n} {{
  distance: float64;
  reason: string | int32;
}}

interface Robot{n} {{
  search(work: Work{n}): Finding{n};
  charge(finding: Finding{n}): void;
}}
"""


def proto(lines: int, name: str = "bench") -> str:
    """Return Protocol Buffers definitions in a package."""
    return _filled(f'syntax = "proto3";\npackage {name};\n', _PROTO, lines, "//")


def sql(lines: int) -> str:
    """Return SQL statements."""
    return _filled("", _SQL, lines, "--")


def python(lines: int) -> str:
    """Return Python classes."""
    return _filled("", _PYTHON, lines, "#")


def typespec(lines: int) -> str:
    """Return TypeSpec models and interfaces."""
    return _filled("", _TYPESPEC, lines, "//")


WRITERS: dict[str, Callable[[int], str]] = {
    "proto": proto,
    "sql": sql,
    "py": python,
    "tsp": typespec,
}
"""Generators by file suffix."""


def _filled(head: str, block: str, lines: int, comment: str) -> str:
    """Repeat a block as often as it fits, and fill up with comments."""
    room = lines - head.count("\n")
    count, left = divmod(room, block.count("\n"))
    return head + "".join(block.format(n=n) for n in range(count)) + f"{comment} .\n" * left
