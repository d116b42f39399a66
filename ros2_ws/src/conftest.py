"""Every test file talks on a DDS domain of its own, so that it hears no other run or cell."""

import itertools
import os
from collections.abc import Iterator

import pytest

_DOMAINS = (1 + number % 100 for number in itertools.count(13 * os.getpid()))


@pytest.fixture(scope='module', autouse=True)
def _own_domain() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv('ROS_DOMAIN_ID', str(next(_DOMAINS)))
        patch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        yield
