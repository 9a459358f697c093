"""Robots of a swarm as they are named in launch files: `uav_1, rover[0]`, or `uav` for a role."""

import re
from typing import Any, NamedTuple

_ROBOT = re.compile(r'(\w+)\[([0-9]+)\]|(\w+)_([0-9]+)')
_MOST = 1000
"""Number of robots that a role may have in a launch."""
_DIGITS = 18
"""Length of the longest number that is read."""
_LONGEST = 86400.0
"""Longest pause, in seconds."""


class Role(NamedTuple):
    """
    A role of a swarm, with `least` robots by default.

    It has `lower` to `upper` robots, without a limit in the model if `upper` is None. `nodes` are
    those of a robot, `bringup` is the launch file with those of its functions and components,
    `servers` are executables with servers of functions.
    """

    least: int
    lower: int
    upper: Any
    nodes: Any
    bringup: str = ''
    servers: Any = ()

    @property
    def most(self):
        """Return the greatest number of robots."""
        return _MOST if self.upper is None else min(self.upper, _MOST)


class RobotError(Exception):
    """A robot that the swarm does not have, or a number of robots that it cannot have."""


def chosen(roles, text, counts):
    """
    Return the number of robots of each role, and those that are named in a text, or all.

    Robots are pairs of role and number. A role has as many robots as `counts` says for it; where
    that is empty, its least number, or as many as the names need.
    """
    named = list(_named(roles, text))
    numbers = {}
    for name, role in roles.items():
        if role.lower > _MOST:
            raise RobotError(f'a launch has {_MOST} of {name} at most, and there are {role.lower}')
        given = counts.get(name, '').strip()
        needed = [number + 1 for each, number in named if each == name and number is not None]
        count = min(max([role.least, *needed]), role.most)
        numbers[name] = _count(name, role, given) if given else count
    robots = []
    for name, number in named or [(name, None) for name in roles]:
        there = numbers[name]
        if number is None:
            robots += [(name, each) for each in range(there)]
        elif number < there:
            robots.append((name, number))
        else:
            raise RobotError(f'there is no {name}_{number}: {_range(name, roles[name], there)}')
    return numbers, list(dict.fromkeys(robots))


def _named(roles, text):
    """Yield the robots in a text; the number is None for all of a role."""
    for name in text.replace(',', ' ').split():
        if name in roles:
            yield name, None
            continue
        match = _ROBOT.fullmatch(name)
        role = match and (match[1] or match[3])
        if not match or role not in roles:
            there = '; '.join(_range(each, roles[each], roles[each].least) for each in roles)
            raise RobotError(f'there is no robot {name}: {there}')
        number = match[2] or match[4]
        if len(number) > _DIGITS:
            raise RobotError(f'there is no robot {name}: its number is too great')
        yield role, int(number)


def _count(name, role, text):
    if not text.isdecimal():
        raise RobotError(f'{name}_count must be a number of robots, not `{text}`')
    if len(text) > _DIGITS or not role.lower <= int(text) <= role.most:
        raise RobotError(f'there cannot be {text} of {name}, but {limits(role)}')
    return int(text)


def delay(text):
    """Return the seconds in a text."""
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if 0 <= seconds <= _LONGEST:
        return seconds
    bounds = f'a number of seconds from 0 to {_LONGEST:.0f}'
    raise RobotError(f'respawn_delay must be {bounds}, not `{text}`')


def limits(role):
    """Return how many robots a role may have."""
    if role.most == role.lower:
        return f'exactly {role.lower}'
    return f'{role.lower} to {role.most}'


def _range(name, role, count):
    """Return which robots of a role there are, and how many there may be."""
    last = f' to {name}_{count - 1}' if count > 1 else ''
    there = f'{name}_0{last}' if count else f'none of {name}'
    return f'there is {there}, and {name}_count can be {limits(role)}'
