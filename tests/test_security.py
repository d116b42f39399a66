"""Where the middleware has no DDS security, a node that must have it does not start."""

import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from push_node.interface import GROUND_TRUTH, PUSHER_VELOCITY_CMD, SERVICES, TOPICS

POLICY = Path(__file__).parents[1] / 'ros2_ws/src/push_bringup/config/security_policy.xml'
NODES = ('cell', 'gp_server', 'mpc_node', 'recorder', 'sim_node')
LIBRARIES = sorted(Path(sys.prefix).glob('lib/libfastrtps.so.*'))
PLUGINS = (b'builtin.PKI-DH', b'builtin.Access-Permissions', b'builtin.AES-GCM-GMAC')


@pytest.mark.processes
def test_a_node_that_must_be_secured_never_runs_unprotected(
    environment: dict[str, str], tmp_path: Path
) -> None:
    if not LIBRARIES:
        pytest.skip('the middleware is not that of the wheels')
    library = LIBRARIES[0].read_bytes()
    if any(name in library for name in PLUGINS):
        pytest.skip('this middleware has security plugins; docs/security.md says how to use them')
    (tmp_path / 'enclaves').mkdir()
    demanded = {
        'ROS_SECURITY_ENABLE': 'true',
        'ROS_SECURITY_STRATEGY': 'Enforce',
        'ROS_SECURITY_KEYSTORE': str(tmp_path),
    }
    node = (sys.executable, '-m', 'push_gp.server.gp_server')
    ended = subprocess.run(
        node, env=environment | demanded, capture_output=True, text=True, timeout=60, check=False
    )
    assert ended.returncode != 0
    assert "doesn't have the security libraries" in ended.stderr


def granted(right: str, group: str, node: str) -> set[str]:
    """What the policy allows a node, by full names."""
    policy = ElementTree.parse(POLICY).getroot()
    (profile,) = policy.iterfind(f'.//profile[@node="{node}"]')
    return {str(each.text) for block in profile.iterfind(f'{group}[@{right}]') for each in block}


def test_the_policy_lets_only_its_publishers_publish_a_topic_and_its_server_serve() -> None:
    for topic in TOPICS:
        name = topic.absolute_name
        publish = {node for node in NODES if name in granted('publish', 'topics', node)}
        assert publish <= set(topic.publishers) or topic.name == '/parameter_events', topic.name
        assert name in granted('subscribe', 'topics', 'recorder')
    for service in SERVICES:
        name = f'/{service.name}'
        assert {node for node in NODES if name in granted('reply', 'services', node)} == {
            service.server
        }


def test_the_policy_lets_the_controller_alone_command_the_tip() -> None:
    command = PUSHER_VELOCITY_CMD.absolute_name
    assert [n for n in NODES if command in granted('publish', 'topics', n)] == ['mpc_node']
    truth = GROUND_TRUTH.absolute_name
    assert truth not in granted('subscribe', 'topics', 'mpc_node')
