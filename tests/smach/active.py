"""Active states of a running SMACH machine, real or stand-in."""


def paths(machine):
    """The labels of the active states without children, by their path."""
    return sorted(_paths(machine, ""))


def settled(machine):
    """Return True if SMACH has reached the active states."""
    for label in running(machine):
        child = machine.get_children()[label]
        if child.following is not child.current or child.current.is_over:
            return False
        if hasattr(child, "get_children") and not settled(child):
            return False
    return True


def _paths(container, path):
    for label in running(container):
        child = container.get_children()[label]
        if hasattr(child, "get_children"):
            yield from _paths(child, f"{path}{label}/")
        else:
            yield f"{path}{label}"


def running(container):
    """The labels of the states in a container that are active."""
    children = container.get_children()
    if hasattr(container, "_child_outcomes"):
        return [label for label, outcome in container._child_outcomes.items() if outcome is None]
    current = getattr(container, "_current_label", getattr(container, "_current", None))
    return [current] if current in children else []
