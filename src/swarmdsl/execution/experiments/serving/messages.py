"""Messages of CPSwarm's optimization, as its package `optimization-messages` 2.0 has them.

    {"type": "RunSimulation", "OID": "sar!1", "SID": "7", "simulationSeed": 3,
     "parameters": [{"name": "altitude", "meta": "file:sar_behavior", "value": 8.0}]}

is answered by

    {"type": "SimulationResult", "OID": "sar!1", "success": true, "SID": "7", "fitnessValue": 12.5}

A field without a value is left out, as Gson does.
"""

from __future__ import annotations

import json
from typing import Any

from swarmdsl.base.records import dataclass

RUN, RESULT = "RunSimulation", "SimulationResult"
STATUS, CONFIGURED = "SimulationManager", "SimulatorConfigured"
_LARGEST_SEED = 2**63
_LARGEST = 1e300


@dataclass(frozen=True)
class Parameter:
    """Value of a parameter; times are in seconds. `meta` is where the tools of CPSwarm put it."""

    name: str
    meta: str
    value: float


@dataclass(frozen=True)
class RunSimulation:
    """Wish to run a candidate: an optimization, a simulation of it, a seed, the parameters."""

    optimization: str | None
    simulation: str | None
    seed: int
    parameters: tuple[Parameter, ...]


def read_message(text: str) -> RunSimulation:
    """Return the message of a text. Raises ValueError, with a reason, if it is another one."""
    try:
        data = json.loads(text)
    # A deep text ends with RecursionError.
    except (ValueError, RecursionError):
        raise ValueError("it is not JSON") from None
    if not isinstance(data, dict) or data.get("type") != RUN:
        found = data.get("type") if isinstance(data, dict) else None
        raise ValueError(f"its `type` is {json.dumps(found)}, not {RUN}")
    names = [data.get("OID"), data.get("SID")]
    if not all(each is None or isinstance(each, str) for each in names):
        raise ValueError("`OID` and `SID` must be strings")
    seed = data.get("simulationSeed", 0)
    if type(seed) is not int or not -_LARGEST_SEED <= seed < _LARGEST_SEED:
        raise ValueError("`simulationSeed` must be a whole number")
    given = data.get("parameters", [])
    if not isinstance(given, list):
        raise ValueError("`parameters` must be a list")
    return RunSimulation(names[0], names[1], seed, tuple(map(_parameter, given)))


def _parameter(data: Any) -> Parameter:
    if not isinstance(data, dict) or not isinstance(data.get("name"), str):
        raise ValueError("a parameter must have a `name`")
    value: Any
    name, value, meta = data["name"], data.get("value"), data.get("meta") or ""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not abs(value) <= _LARGEST:
        raise ValueError(f"the `value` of `{name}` must be a number")
    if not isinstance(meta, str):
        raise ValueError(f"the `meta` of `{name}` must be a string")
    return Parameter(name, meta, float(value))


def result_text(of: RunSimulation, fitness: float | None) -> str:
    """Return the answer to a wish; None says that the candidate has no fitness."""
    data: dict[str, Any] = {"type": RESULT}
    if of.optimization is not None:
        data["OID"] = of.optimization
    data["success"] = fitness is not None
    if of.simulation is not None:
        data["SID"] = of.simulation
    data["fitnessValue"] = fitness if fitness is not None else 0.0
    return json.dumps(data)


def status_text() -> str:
    """Return the presence of a simulation manager: what it can do.

    Without a configuration it is fit for all of them, and with 0 agents for any number.
    """
    return json.dumps({"type": STATUS, "capabilities": {"dimensions": 2, "maxAgents": 0}})


def configured_text() -> str:
    """Return the answer to the files of a configuration."""
    return json.dumps({"type": CONFIGURED, "success": True})
