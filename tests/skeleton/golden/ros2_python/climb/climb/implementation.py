"""Send the take-off command.
Says \"when\" \\ it is there.

This file is yours: it was written once. See base.py for the base class.
swarmc:fits c132a845
"""

from climb.base import ClimbBase


class Climb(ClimbBase):
    """Send the take-off command.
    Says \"when\" \\ it is there."""

    def execute(self, goal):
        """Process a goal: return `succeeded`, `aborted` or `preempted`.

        goal.height : float64 - How high, in metres.
        result.reached : float64
        feedback.now : float64
        """
        while not self.cancelled():
            # Process it here, with self.wait(0.1) between two steps, and return
            # self.succeeded(self.Result(...)) at its end.
            return self.aborted('climb is not implemented')
        return self.preempted()

    def on_state(self, message):
        """state: demo.msg.Sample; also in self.inputs.state."""
