"""Picture of a scene of MuJoCo as PNG, without a window."""

from __future__ import annotations

import struct
import sys
import zlib
from importlib import import_module
from typing import Any

import mujoco
import numpy as np

from swarmdsl.execution.physics.scene import Scene
from swarmdsl.execution.simulate.scenario.space import NoPictureError

_WIDTH, _HEIGHT = 1280, 960
_NEAREST = 6.0
"""Least distance of the camera from what it looks at, in metres."""
_AWAY = 1.6
"""Distance of the camera, relative to how far robots are from each other."""
_ELEVATION = -50.0
_MOST_SHAPES = 10_000


def picture(scene: Scene) -> bytes:
    """Return a picture of all robots of a scene, as PNG. Raises NoPictureError."""
    try:
        return png(_drawn(scene), _WIDTH)
    except Exception as error:  # of OpenGL and of its platform, with classes of their own
        reason = " ".join(str(error).split())
        raise NoPictureError(reason or type(error).__name__) from error


def _drawn(scene: Scene) -> bytes:
    """Return the pixels of a picture, line by line from the top."""
    module = "mujoco.egl" if sys.platform == "linux" else "mujoco"
    context = import_module(module).GLContext(_WIDTH, _HEIGHT)
    try:
        context.make_current()
        model = scene.model
        model.vis.global_.offwidth, model.vis.global_.offheight = _WIDTH, _HEIGHT
        model.vis.headlight.ambient[:], model.vis.headlight.diffuse[:] = 0.5, 0.5
        drawing = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, drawing)
        shapes, options = mujoco.MjvScene(model, maxgeom=_MOST_SHAPES), mujoco.MjvOption()
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(model, scene.data, options, None, _camera(scene), everything, shapes)
        whole = mujoco.MjrRect(0, 0, _WIDTH, _HEIGHT)
        mujoco.mjr_render(whole, shapes, drawing)
        pixels = np.empty((_HEIGHT, _WIDTH, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, whole, drawing)
        drawing.free()
        return pixels[::-1].tobytes()
    finally:
        context.free()


def _camera(scene: Scene) -> Any:
    """Return a camera in the south that has all robots in view."""
    places = scene.places
    low, high = places.min(axis=0), places.max(axis=0)
    camera = mujoco.MjvCamera()
    camera.lookat[:] = (low + high) / 2
    camera.distance = max(_AWAY * float((high - low).max()), _NEAREST)
    camera.azimuth, camera.elevation = 90.0, _ELEVATION
    return camera


def png(pixels: bytes, width: int) -> bytes:
    """Return a picture as PNG: rows of pixels, each three bytes. Source: RFC 2083."""
    line = 3 * width
    rows = [b"\0" + pixels[at : at + line] for at in range(0, len(pixels), line)]
    head = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    chunks = (b"IHDR", head), (b"IDAT", zlib.compress(b"".join(rows))), (b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*chunk) for chunk in chunks)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
