"""Every import of a package is declared in its package.xml and setup.py."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest

SOURCES = Path(__file__).parents[1] / 'ros2_ws' / 'src'
PACKAGES = sorted(path.parent.name for path in SOURCES.glob('*/setup.py'))
# name in setup.py where it is not that of the module
PIP_NAMES = {
    'foxglove': 'foxglove-sdk',
    'mcap_ros2': 'mcap-ros2-support',
    'sklearn': 'scikit-learn',
    'yaml': 'PyYAML',
}
# keys of rosdep's public python.yaml; the other modules have none
ROSDEP_KEYS = {
    'casadi': 'casadi-pip',
    'hypothesis': 'python3-hypothesis',
    'mcap_ros2': 'mcap-ros2-support',
    'numpy': 'python3-numpy',
    'pybullet': 'python3-pybullet-pip',
    'pytest': 'python3-pytest',
    'rosbags': 'python3-rosbags-pip',
    'scipy': 'python3-scipy',
    'sklearn': 'python3-sklearn',
    'rich': 'python3-rich',
    'tqdm': 'python3-tqdm',
    'websockets': 'python3-websockets',
    'yaml': 'python3-yaml',
}
TOOLS = {path.stem for path in (Path(__file__).parent / 'tools').rglob('*.py')}
ROS = re.compile(r'push_\w+|\w+_msgs|\w+_interfaces|std_srvs|rclpy|ament_index_python|launch\w*')


def imported(folder: Path) -> set[str]:
    """Modules that are not of the standard library, without their submodules."""
    return {
        name
        for path in folder.rglob('*.py')
        for name in _names(ast.parse(path.read_text(encoding='utf-8')))
        if name not in sys.stdlib_module_names | TOOLS
    }


def _names(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition('.')[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield str(node.module).partition('.')[0]


def declared(package: str, *kinds: str) -> set[str]:
    """Keys of package.xml."""
    root = ElementTree.parse(SOURCES / package / 'package.xml').getroot()
    return {str(element.text) for kind in kinds for element in root.iter(kind)}


def required(package: str, *, extras: bool) -> set[str]:
    """Names in setup.py without their versions."""
    tree = ast.parse((SOURCES / package / 'setup.py').read_text(encoding='utf-8'))
    values = {node.arg: node.value for node in ast.walk(tree) if isinstance(node, ast.keyword)}
    names = ast.literal_eval(values['install_requires'])
    if extras:
        names += [
            name for own in ast.literal_eval(values['extras_require']).values() for name in own
        ]
    return {re.split('[=<>~]', name)[0] for name in names}


def split(modules: set[str], package: str) -> tuple[set[str], set[str]]:
    """Modules of the workspace or of ROS, and others."""
    ros = {name for name in modules if ROS.fullmatch(name)}
    return ros - {package}, modules - ros


@pytest.mark.parametrize('package', PACKAGES)
def test_package_xml_declares_what_is_imported(package: str) -> None:
    folders = (SOURCES / package / package, SOURCES / package / 'launch')
    ros, others = split(set().union(*map(imported, folders)), package)
    optional = required(package, extras=True) - required(package, extras=False)
    needed = {name for name in others if PIP_NAMES.get(name, name) not in optional}
    keys = ros | {ROSDEP_KEYS[name] for name in needed & set(ROSDEP_KEYS)}
    assert keys - declared(package, 'exec_depend') == set()
    text = (SOURCES / package / 'package.xml').read_text(encoding='utf-8')
    without_key = {PIP_NAMES.get(name, name) for name in needed - set(ROSDEP_KEYS)}
    assert {name for name in without_key if name not in text} == set()


@pytest.mark.parametrize('package', PACKAGES)
def test_package_xml_declares_what_tests_import(package: str) -> None:
    ros, others = split(imported(SOURCES / package / 'test'), package)
    keys = ros | {ROSDEP_KEYS[name] for name in others & set(ROSDEP_KEYS)}
    assert keys - declared(package, 'exec_depend', 'test_depend') == set()


@pytest.mark.parametrize('package', PACKAGES)
def test_setup_py_requires_what_is_imported(package: str) -> None:
    _, others = split(imported(SOURCES / package / package), package)
    names = {PIP_NAMES.get(name, name) for name in others}
    assert names - required(package, extras=True) == set()


@pytest.mark.parametrize('package', PACKAGES)
def test_package_xml_has_only_keys_that_rosdep_knows(package: str) -> None:
    keys = declared(package, 'exec_depend', 'test_depend')
    assert {key for key in keys if not ROS.fullmatch(key)} - set(ROSDEP_KEYS.values()) == set()
