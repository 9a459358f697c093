from __future__ import annotations

import pytest

pytest.importorskip("mujoco", reason="needs MuJoCo: pip install 'swarmdsl[physics]'")
