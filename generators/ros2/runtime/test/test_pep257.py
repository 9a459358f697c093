"""Test with pydocstyle and the rules of ROS 2."""

import pytest

linter = pytest.importorskip('ament_pep257.main')


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    """Expect no findings."""
    assert linter.main(argv=['.', 'test']) == 0
