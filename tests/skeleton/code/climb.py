"""A climb that ends in each way, by the height that is asked for."""

from climb.base import ClimbBase


class Climb(ClimbBase):
    """Ends as it is told to."""

    def execute(self, goal):
        """End in the way of the height."""
        if goal.height == 1:
            self.publish_feedback(self.Feedback(now=0.5))
            self.wait(0.1)
            if self.inputs.state is not None:
                self.outputs.pos_goal_position.publish(self.inputs.state)
            return self.succeeded(self.Result(reached=goal.height + self.parameters.tolerance))
        if goal.height == 2:
            raise ValueError("too high")
        if goal.height == 3:
            while self.wait(0.02):
                pass
            return self.preempted("left")
        if goal.height == 4:
            return None
        return self.succeeded(self.Result(reached="no number"))
