"""Lease of a node: a file that is locked while its process lives, for a watchdog."""

import fcntl
from pathlib import Path
import time

from . import parameters
from .parameters import Parameter, StartError

RUNNING, ENDED = 'running', 'ended'
"""Words in the file while the process runs, and when it has ended by itself."""

_SETTINGS = (Parameter('lease.file', 'string', '', 'File that is locked while the node lives.'),)
_PATIENCE = 2.0
"""Time for which another process may have the lock, in seconds: a watchdog looks at the file."""
_PAUSE = 0.05
_held = {}


def hold(node):
    """Lock the file of a node until it ends; the system unlocks it, however its process ends."""
    parameters.declare(node, _SETTINGS)
    path = parameters.values(node, _SETTINGS)['lease.file']
    if not path:
        return
    try:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        file = Path(path).open('a', encoding='utf-8')  # noqa: SIM115
    except OSError as error:
        raise StartError(f'parameter `lease.file`: {error}') from None
    until = time.monotonic() + _PATIENCE
    while not locked(file):
        if time.monotonic() > until:
            raise StartError(f'parameter `lease.file`: another node has {path}')
        time.sleep(_PAUSE)
    note(file, RUNNING)
    _held[node] = file


def leave(node, is_well):
    """Unlock the file of a node; nothing has to be done for one that ends as it should."""
    file = _held.pop(node, None)
    if file is not None:
        if is_well:
            note(file, ENDED)
        file.close()


def locked(file):
    """Lock a file and return True, unless another process has locked it."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def note(file, text):
    """Replace what a file says."""
    file.truncate(0)
    file.write(text)
    file.flush()
