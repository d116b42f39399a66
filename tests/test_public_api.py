"""The names that each package offers to scripts: they exist, are typed, cheap and documented."""

import ast
import importlib
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ('push_core', 'push_sim', 'push_gp', 'push_mpc', 'push_bag', 'push_bringup')
HEAVY = ('numpy', 'scipy', 'rclpy', 'pybullet', 'osqp', 'casadi', 'plotly', 'mcap', 'yaml')


def typed_exports(package: str) -> dict[str, str]:
    """Names to modules, as a type checker sees them."""
    source = ROOT / 'ros2_ws' / 'src' / package / package / '__init__.py'
    imports = [
        node
        for node in ast.walk(ast.parse(source.read_text(encoding='utf-8')))
        if isinstance(node, ast.ImportFrom)
    ]
    return {
        name.name: str(node.module)
        for node in imports
        for name in node.names
        if str(node.module).startswith(f'{package}.') and name.asname == name.name
    }


@pytest.mark.parametrize('package', PACKAGES)
def test_a_script_gets_what_the_type_checker_sees(package: str) -> None:
    module = importlib.import_module(package)
    exports = typed_exports(package)
    assert set(module.__all__) == set(exports)
    for name, home in exports.items():
        assert getattr(module, name) is getattr(importlib.import_module(home), name)


@pytest.mark.parametrize('package', PACKAGES)
def test_no_exported_name_is_that_of_a_wing(package: str) -> None:
    folder = ROOT / 'ros2_ws' / 'src' / package / package
    assert not {path.stem for path in folder.iterdir()} & set(typed_exports(package))


@pytest.mark.parametrize('package', PACKAGES)
def test_an_unknown_name_is_an_attribute_error(package: str) -> None:
    with pytest.raises(AttributeError, match='no attribute'):
        _ = importlib.import_module(package).no_such_name


def test_importing_the_packages_loads_nothing_heavy() -> None:
    loaded = f'sorted(set({HEAVY!r}) & set(__import__("sys").modules))'
    command = f'import {", ".join(PACKAGES)}; print({loaded})'
    done = subprocess.run([sys.executable, '-c', command], capture_output=True, check=True)
    assert done.stdout.decode().strip() == '[]'


@pytest.mark.parametrize('package', PACKAGES)
def test_the_page_of_the_api_lists_every_name(package: str) -> None:
    page = (ROOT / 'docs' / 'api.md').read_text(encoding='utf-8')
    section = page.partition(f'\n## {package}\n')[2].partition('\n## ')[0]
    rows = re.findall(r'^\| (`[^|]*) \|', section, re.MULTILINE)
    listed = {name for row in rows for name in re.findall(r'`(\w+)[(`]', row)}
    assert listed == set(importlib.import_module(package).__all__)
