"""Fields that lowering computes from the rest of the model.

They do not count in comparisons: nodes that were not lowered, such as an importer's, leave
them empty.
"""

from collections.abc import Mapping

DERIVED: Mapping[str, bool] = {"derived": True}
"""Metadata of such a field. The dump of the IR shows it."""
