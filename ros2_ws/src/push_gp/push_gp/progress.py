"""Progress of a long command, on standard error where somebody watches it."""

import sys


class Progress:
    """One line that grows with each step: `fitting 200 pushes: dx dy dtheta`."""

    def __init__(self, title: str) -> None:
        self._watched = sys.stderr.isatty()
        self._write(f'{title}:')

    def step(self, name: str) -> None:
        """Says that a step is done."""
        self._write(f' {name}')

    def done(self) -> None:
        """Ends the line."""
        self._write('\n')

    def _write(self, text: str) -> None:
        if self._watched:
            sys.stderr.write(text)
            sys.stderr.flush()
