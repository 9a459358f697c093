"""Look at all states of JANI models with Storm: `python -m tests.agreement.storm FILE...`.

Storm has a process of its own, as its licence is another one. Prints a line of JSON for each file:
the number of states without regard to properties, and if all properties hold.
"""

from __future__ import annotations

import json
import sys

import stormpy


def main() -> None:
    """Check the files."""
    for path in sys.argv[1:]:
        model, properties = stormpy.parse_jani_model(path)
        states = stormpy.build_model(model).nr_states
        holds = [_holds(model, each) for each in properties]
        sys.stdout.write(json.dumps([states, all(holds)]) + "\n")


def _holds(model: stormpy.JaniModel, property_: stormpy.Property) -> bool:
    # Whatever comes after a violation is not built.
    built = stormpy.build_model(model, [property_])
    found = stormpy.model_checking(built, property_, only_initial_states=True)
    return bool(found.forall_true())


if __name__ == "__main__":
    main()
