"""Delayed calls by a clock of ROS, with one timer for the earliest, and pauses between calls."""

import heapq
from itertools import count

_FIRST_PAUSE = 100_000_000
_LONGEST_PAUSE = 1_000_000_000
_LONGEST = 86_400_000_000_000
"""Maximum period of a timer in nanoseconds: ROS adds it to the time in 64 bits."""


class Alarms:
    """
    Calls functions after delays in nanoseconds; functions due together run in order of creation.

    `post` runs a function when no other function is running.
    """

    def __init__(self, node, clock, group, post):
        self._node = node
        self._clock = clock
        self._group = group
        self._post = post
        self._waiting = []
        self._numbers = count()
        self._timer = None

    @property
    def now(self):
        """Return the time of the clock, in nanoseconds."""
        return self._clock.now().nanoseconds

    def post(self, action):
        """Run an action when no other function is running."""
        self._post(action)

    def schedule(self, delay, action):
        """Call the action once after a delay; return a handle for `unschedule`."""
        alarm = [self.now + delay, next(self._numbers), action]
        heapq.heappush(self._waiting, alarm)
        if self._waiting[0] is alarm:
            self._set()
        return alarm

    def unschedule(self, alarm):
        """Cancel a delayed call."""
        alarm[2] = None
        if self._waiting and self._waiting[0] is alarm:
            self._set()

    def clear(self):
        """Cancel all calls, and destroy the timer."""
        self._waiting.clear()
        if self._timer is not None:
            self._node.destroy_timer(self._timer)
            self._timer = None

    def _set(self):
        """Set the timer to the first call."""
        while self._waiting and self._waiting[0][2] is None:
            heapq.heappop(self._waiting)
        if not self._waiting:
            if self._timer is not None:
                self._timer.cancel()
            return
        delay = min(max(self._waiting[0][0] - self.now, 1), _LONGEST)
        if self._timer is None:
            self._timer = self._node.create_timer(
                delay / 1e9, self._ring, callback_group=self._group, clock=self._clock
            )
        else:
            self._timer.timer_period_ns = delay
            self._timer.reset()

    def _ring(self):
        self._post(self._call_due)

    def _call_due(self):
        """Call all actions that are due, including those that become due meanwhile."""
        now = self.now
        while self._waiting and self._waiting[0][0] <= now:
            action = heapq.heappop(self._waiting)[2]
            if action is not None:
                action()
        self._set()


class Pauses:
    """
    Pauses before functions are called again at once after they were aborted, in nanoseconds.

    The pause doubles with each abort in a row. Without it, a machine that tries again would call a
    server that fails at once some hundred times per second.
    """

    def __init__(self):
        self._aborted = {}

    def note(self, run, event, now):
        """Note the end of an activity."""
        name = run.activity.name
        if event.name != run.activity.events['aborted']:
            self._aborted.pop(name, None)
            return
        _, pause = self._aborted.get(name, (now, 0))
        self._aborted[name] = now, min(max(2 * pause, _FIRST_PAUSE), _LONGEST_PAUSE)

    def before(self, run, now):
        """Return how long a call has to wait; a call that comes later ends the row."""
        since, pause = self._aborted.get(run.activity.name, (now, 0))
        left = since + pause - now
        if left <= 0:
            self._aborted.pop(run.activity.name, None)
        return max(left, 0)
