"""Test with flake8 and the rules of ROS 2."""

from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    """Expect no findings."""
    code, errors = main_with_errors(argv=[])
    assert code == 0, '\n'.join(errors)
