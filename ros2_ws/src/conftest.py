"""What the tests of all packages share: they hear no other run, and no clock drives them."""

import itertools
import os
import signal
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

# how long an example takes is up to the machine
settings.register_profile('untimed', deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile('untimed')

_DOMAINS = (1 + number % 100 for number in itertools.count(13 * os.getpid()))


@pytest.fixture(scope='session', autouse=True)
def _interrupts_heard() -> None:
    """Also where the tests run in the background, which ignores Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope='module', autouse=True)
def _own_domain() -> Iterator[None]:
    """Gives each test file a DDS domain of its own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv('ROS_DOMAIN_ID', str(next(_DOMAINS)))
        patch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        yield
