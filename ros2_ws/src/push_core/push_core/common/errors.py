"""The exceptions of the project. A command prints each as one line."""


class PushError(Exception):
    """An error that a user can act on; the message is one line.

    Attributes:
        status: exit status of a command that ends with this error.
    """

    status = 1


class InputError(PushError):
    """The command, a parameter or an input file is wrong."""

    status = 2


class RunError(PushError):
    """A run or a check failed although its input was valid."""

    status = 1
