"""Leads nodes in containers of their own through one run: reset, start, watch."""

import sys

from push_bringup.graph.conductor import Conductor


class Elsewhere:
    """Processes that the container engine watches."""

    def check(self) -> None:
        """Nothing to see from here."""


def main() -> int:
    """Runs once; the status is 1 if the lap was not completed."""
    conductor = Conductor('', Elsewhere(), alone=False)
    try:
        reason = conductor.run()
    except KeyboardInterrupt:
        return 130
    finally:
        conductor.close()
    if reason:
        sys.stderr.write(f'lap: {reason}\n')
    return 1 if reason else 0


if __name__ == '__main__':
    sys.exit(main())
