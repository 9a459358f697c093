"""A camera that sees what it is exposed to."""

import demo.msg
from camera.base import CameraBase


class Camera(CameraBase):
    """Tells what it gets."""

    def handle_snap(self, request, response):
        """Store what is not too large; stumble over what is far too large."""
        response.stored = request.zoom < self.parameters.rate
        return response if request.zoom < 100 else None

    def on_exposure(self, message):
        """Say that something was seen, or stumble."""
        self.outputs.seen.publish(demo.msg.Sample(value=[1 / message.data]))
