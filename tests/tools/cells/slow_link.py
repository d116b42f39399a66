"""A network link between two network namespaces with delay, jitter and loss, in user space.

    python tests/tools/cells/slow_link.py LEFT RIGHT --delay 5 --jitter 2 --loss 0.5

It makes the TAP device `wire` in each namespace and carries their Ethernet frames, in order, until
it is ended; it prints a line when both are there. It stands for netem where the kernel has none.
Needs root.
"""

import argparse
import contextlib
import ctypes
import fcntl
import os
import random
import select
import struct
import time
from collections import deque
from dataclasses import dataclass, field
from pathlib import Path

_SET_DEVICE = 0x400454CA  # TUNSETIFF of linux/if_tun.h
_TAP, _WITHOUT_HEADER = 0x0002, 0x1000
_NETWORK = 0x40000000  # CLONE_NEWNET
_LONGEST_FRAME = 65536


@dataclass
class Way:
    """The frames on their way to one device."""

    device: int
    frames: deque[tuple[float, bytes]] = field(default_factory=deque)

    def take(self, frame: bytes, arrives: float) -> None:
        """Takes a frame that arrives at a time [s], not before the one that it follows."""
        latest = self.frames[-1][0] if self.frames else arrives
        self.frames.append((max(arrives, latest), frame))

    def deliver(self, now: float) -> None:
        """Delivers what has arrived by now [s]."""
        while self.frames and self.frames[0][0] <= now:
            # a device that is down takes no frames
            with contextlib.suppress(OSError):
                os.write(self.device, self.frames.popleft()[1])


def device_in(namespace: str) -> int:
    """A TAP device of this name in a network namespace."""
    library = ctypes.CDLL(None, use_errno=True)
    with Path(f'/run/netns/{namespace}').open('rb') as place:
        if library.setns(place.fileno(), _NETWORK) != 0:
            raise OSError(ctypes.get_errno(), f'cannot enter the network namespace {namespace}')
    device = os.open('/dev/net/tun', os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(device, _SET_DEVICE, struct.pack('16sH', b'wire', _TAP | _WITHOUT_HEADER))
    return device


def carry(ways: dict[int, Way], delay: float, jitter: float, loss: float) -> None:
    """Carries frames between two devices until the process is ended; times in [s]."""
    while True:
        due = [way.frames[0][0] for way in ways.values() if way.frames]
        patience = max(0.0, min(due) - time.monotonic()) if due else None
        ready, _, _ = select.select(list(ways), [], [], patience)
        for device in ready:
            frame = os.read(device, _LONGEST_FRAME)
            if random.random() >= loss:
                wait = delay + random.uniform(-jitter, jitter)
                ways[device].take(frame, time.monotonic() + wait)
        for way in ways.values():
            way.deliver(time.monotonic())


def main() -> None:
    """Makes the devices and carries frames between them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('namespaces', nargs=2)
    parser.add_argument('--delay', type=float, default=0.2, help='one way [ms]')
    parser.add_argument('--jitter', type=float, default=0.0, help='at most, both ways [ms]')
    parser.add_argument('--loss', type=float, default=0.0, help='of frames [%%]')
    arguments = parser.parse_args()
    left, right = map(device_in, arguments.namespaces)
    random.seed(0)
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(40))
    print('ready', flush=True)
    ways = {left: Way(right), right: Way(left)}
    carry(ways, 1e-3 * arguments.delay, 1e-3 * arguments.jitter, 1e-2 * arguments.loss)


if __name__ == '__main__':
    main()
