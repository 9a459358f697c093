"""The linter flake8, with the rules of ROS 2."""

from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    """Find nothing wrong."""
    code, errors = main_with_errors(argv=[])
    assert code == 0, '\n'.join(errors)
