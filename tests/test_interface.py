"""Topics and services are defined in `push_node.interface` alone, and listed in the README."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from push_node.interface import SERVICES, TOPICS
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

ROOT = Path(__file__).parents[1]
SOURCES = ROOT / 'ros2_ws' / 'src'
OWN = {SOURCES / 'push_node' / 'push_node' / name for name in ('interface.py', 'endpoints.py')}
MODULES = sorted(
    path
    for folder in SOURCES.iterdir()
    for path in [*folder.glob(f'{folder.name}/**/*.py'), *folder.glob('launch/*.py')]
    if path not in OWN
)
ENDPOINTS = {'create_publisher', 'create_subscription', 'create_client', 'create_service'}
# the others are also words that figures and tables use
TELLING = {topic.name.lstrip('/') for topic in TOPICS if '_' in topic.name}
ABSOLUTE = {topic.absolute_name for topic in TOPICS}
SERVICE = re.compile('|'.join(re.escape(service.name) for service in SERVICES))


def parsed_modules() -> Iterator[tuple[Path, ast.Module]]:
    for path in MODULES:
        yield path.relative_to(SOURCES), ast.parse(path.read_text(encoding='utf-8'))


def strings(module: ast.Module) -> Iterator[ast.Constant]:
    """String literals, without those that stand alone: docstrings."""
    alone = {id(node.value) for node in ast.walk(module) if isinstance(node, ast.Expr)}
    for node in ast.walk(module):
        is_string = isinstance(node, ast.Constant) and isinstance(node.value, str)
        if is_string and id(node) not in alone:
            yield node


def names_an_endpoint(text: str) -> bool:
    return text in TELLING | ABSOLUTE or bool(SERVICE.search(text))


def called(call: ast.Call) -> str:
    return call.func.attr if isinstance(call.func, ast.Attribute) else ''


def test_no_other_module_names_a_topic_or_a_service() -> None:
    named = [
        f'{path}:{each.lineno}'
        for path, module in parsed_modules()
        for each in strings(module)
        if names_an_endpoint(each.value)
    ]
    assert named == []


def test_no_other_module_gives_an_endpoint_a_literal_name() -> None:
    named = [
        f'{path}:{node.lineno}'
        for path, module in parsed_modules()
        for node in ast.walk(module)
        if isinstance(node, ast.Call) and called(node) in ENDPOINTS
        if any(isinstance(each, ast.Constant | ast.JoinedStr) for each in node.args)
    ]
    assert named == []


def test_the_search_finds_names() -> None:
    module = ast.parse("'/tf'; f(x='object_pose'); g('/tf'); h('call push_mpc/stop')")
    found = {each.value for each in strings(module) if names_an_endpoint(each.value)}
    assert found == {'object_pose', '/tf', 'call push_mpc/stop'}


@pytest.mark.parametrize('endpoint', [*TOPICS, *SERVICES], ids=lambda endpoint: endpoint.name)
def test_every_type_is_installed(endpoint) -> None:
    made = getattr(endpoint, 'message_class', None) or endpoint.service_class
    package, _, name = endpoint.type_name.split('/')
    assert (made.__module__.split('.')[0], made.__name__) == (package, name)


@pytest.mark.parametrize('names', [[each.name for each in table] for table in (TOPICS, SERVICES)])
def test_names_are_unique(names: list[str]) -> None:
    assert len(set(names)) == len(names)


@pytest.mark.parametrize('topic', TOPICS, ids=lambda topic: topic.name)
def test_the_readme_has_the_row_of_each_topic(topic) -> None:
    publishers = ', '.join(f'`{name}`' for name in topic.publishers)
    row = (
        f'| `{topic.name}` | `{short_type(topic.type_name)}` | {qos_text(topic.qos)} '
        f'| {topic.rate} | {publishers} | {topic.description} |'
    )
    assert row in rows_of_readme()


@pytest.mark.parametrize('service', SERVICES, ids=lambda service: service.name)
def test_the_readme_has_the_row_of_each_service(service) -> None:
    row = (
        f'| `{service.name}` | `{short_type(service.type_name)}` | `{service.server}` '
        f'| {service.description} |'
    )
    assert row in rows_of_readme()


def test_the_readme_has_no_row_of_anything_else() -> None:
    known = {each.name for each in (*TOPICS, *SERVICES)}
    rows = [row for row in rows_of_readme() if re.match(r'\| `[^`]+` \| `\w+/\w+` \|', row)]
    assert {row.split('`')[1] for row in rows} == known


def rows_of_readme() -> list[str]:
    return (ROOT / 'README.md').read_text(encoding='utf-8').splitlines()


def short_type(type_name: str) -> str:
    package, _, name = type_name.split('/')
    return f'{package}/{name}'


def qos_text(profile: QoSProfile) -> str:
    best_effort = profile.reliability == ReliabilityPolicy.BEST_EFFORT
    parts = ['best effort' if best_effort else 'reliable']
    if profile.durability == DurabilityPolicy.TRANSIENT_LOCAL:
        parts.append('transient local')
    parts.append(f'depth {profile.depth}')
    if profile.deadline.nanoseconds:
        parts.append(f'deadline {profile.deadline.nanoseconds // 1_000_000} ms')
    return ', '.join(parts)
