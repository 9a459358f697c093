"""Test with flake8 and the rules of ROS 2."""

import pytest

linter = pytest.importorskip('ament_flake8.main')


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    """Expect no findings."""
    code, errors = linter.main_with_errors(argv=[])
    assert code == 0, '\n'.join(errors)
