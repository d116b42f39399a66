"""What the tests of all packages share: they hear no other run, and no clock drives them."""

import signal
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings
from node_tests import own_domain, starts_nodes

# how long an example takes is up to the machine
settings.register_profile('untimed', deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile('untimed')


@pytest.fixture(scope='session', autouse=True)
def _interrupts_heard() -> None:
    """Also where the tests run in the background, which ignores Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope='session', autouse=True)
def _own_domain() -> Iterator[None]:
    """Gives each test process a DDS domain of its own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv('ROS_DOMAIN_ID', own_domain())
        patch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        yield


@pytest.fixture(scope='module', autouse=True)
def _nodes_apart(request: pytest.FixtureRequest, _own_domain: None) -> Iterator[None]:
    """Gives each file of tests that start nodes a further domain."""
    if not starts_nodes(request):
        yield
        return
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv('ROS_DOMAIN_ID', own_domain())
        yield
