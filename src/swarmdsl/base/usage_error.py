"""What is wrong with a command line, apart from what is done for it."""


class UsageError(Exception):
    """What is asked for on the command line cannot be meant; nothing has been done yet."""
