"""A network namespace in which nodes run as on another machine, and the link to it.

Two ends of a virtual cable: one here, one there. It needs root, iproute2, and a kernel that lets
this process make namespaces.
"""

import os
import shutil
import subprocess

from push_core.common import RunError

# a process that lives has no other with its number; the rest of the block is a second machine
_NET = f'10.79.{os.getpid() % 256}'
_HERE, _THERE = f'{_NET}.1', f'{_NET}.2'
_CABLE = 'wire'
# shared memory would reach across, network or not
_ENVIRONMENT = (f'ROS_STATIC_PEERS={_HERE}', 'FASTDDS_BUILTIN_TRANSPORTS=UDPv4')


class Link:
    """A network namespace, and a link to it that can be cut.

    Attributes:
        prefix: words before a command, so that it runs in the namespace.
    """

    def __init__(self) -> None:
        """Makes both.

        Raises:
            RunError: the kernel or the rights do not permit it.
        """
        self._namespace = self._end = f'push{os.getpid()}'
        self.prefix = ('ip', 'netns', 'exec', self._namespace, 'env', *_ENVIRONMENT)
        _ip('netns', 'add', self._namespace)
        try:
            self._connect()
        except RunError:
            self.close()
            raise

    def _connect(self) -> None:
        there = ('peer', 'name', _CABLE, 'netns', self._namespace)
        _ip('link', 'add', self._end, 'type', 'veth', *there)
        _ip('address', 'add', f'{_HERE}/24', 'dev', self._end)
        _ip('-n', self._namespace, 'address', 'add', f'{_THERE}/24', 'dev', _CABLE)
        _ip('-n', self._namespace, 'link', 'set', 'dev', 'lo', 'up')
        _ip('-n', self._namespace, 'link', 'set', 'dev', _CABLE, 'up')
        self.join()

    def cut(self) -> None:
        """Nothing passes from here on."""
        _ip('link', 'set', 'dev', self._end, 'down')

    def join(self) -> None:
        """Connects again."""
        _ip('link', 'set', 'dev', self._end, 'up')

    def close(self) -> None:
        """Removes the namespace, and with it the link."""
        _ip('netns', 'del', self._namespace)


def obstacle() -> str:
    """Why no link can be made here, empty if one can."""
    if os.geteuid() != 0:
        return 'network namespaces need root'
    if shutil.which('ip') is None:
        return 'needs iproute2'
    try:
        Link().close()
    except RunError as error:
        return f'no network namespaces here: {error}'
    return ''


def _ip(*words: str) -> None:
    done = subprocess.run(['ip', *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RunError(f'ip {" ".join(words)}: {done.stderr.strip()}')
