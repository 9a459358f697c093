"""A camera that sees what it is exposed to."""

import demo.msg
import demo.srv
from camera.base import CameraBase


class Camera(CameraBase):
    """Tells what it gets."""

    def handle_snap(self, request):
        """Store what is not too large."""
        return demo.srv.CameraSnapResponse(stored=request.zoom < self.parameters.rate)

    def on_exposure(self, message):
        """Say that something was seen."""
        self.outputs.seen.publish(demo.msg.Sample(value=[message.data]))
