"""The errors of the project: one small tree, turned into one line at the command's edge."""


class PushError(Exception):
    """Anything that a user can act on; the message is one line that says what to do.

    Attributes:
        status: exit status of a command that ends with this error.
    """

    status = 1


class InputError(PushError):
    """The command, a parameter or an input file is wrong."""

    status = 2


class RunError(PushError):
    """A run or a check failed after its input had been accepted."""

    status = 1
