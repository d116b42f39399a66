"""The shape of the source tree, beside the import contracts of pyproject.toml."""

import ast
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

SOURCES = Path(__file__).parents[1] / 'ros2_ws' / 'src'
MODULES = {
    '.'.join(path.relative_to(package).with_suffix('').parts): path
    for package in SOURCES.iterdir()
    for path in package.glob(f'{package.name}/**/*.py')
}
TOOLS = {path.stem: path for path in (Path(__file__).parent / 'tools').rglob('*.py')}
LARGEST_FOLDER = 14
# they load ROS, plotly or another heavy library, which only some users of their wing need
IMPORTED_BY_NAME = {
    'push_bag.live.live_server',
    'push_bag.record.recorder',
    'push_bag.record.recording',
    'push_bag.replay.node_comparison',
    'push_bag.report.live_page',
    'push_bringup.driver_check.driver_client',
    'push_bringup.faults.campaign',
    'push_bringup.faults.kinds',
    'push_bringup.graph.starter',
    'push_gp.server.conversions',
    'push_gp.training.fit_cone',
    'push_gp.training.train',
    'push_mpc.node.horizon_message',
}


def wing_of(module: str) -> str:
    return module.rpartition('.')[0]


def parsed(module: str) -> ast.Module:
    return ast.parse((MODULES | TOOLS)[module].read_text(encoding='utf-8'))


def imports_across_wings() -> Iterator[tuple[str, str]]:
    """Importing module, imported module, of all imports at the top of a module."""
    for module in MODULES:
        for node in parsed(module).body:
            if not isinstance(node, ast.ImportFrom) or node.module not in MODULES:
                continue
            if node.module.count('.') > 1 and wing_of(node.module) != wing_of(module):
                yield module, node.module


def test_no_folder_is_too_full() -> None:
    sizes: dict[Path, int] = defaultdict(int)
    for module, path in MODULES.items():
        if not module.endswith('__init__'):
            sizes[path.parent] += 1
    for tool in TOOLS.values():
        sizes[tool.parent] += 1
    assert {str(folder): n for folder, n in sizes.items() if n > LARGEST_FOLDER} == {}


@pytest.mark.parametrize('module', [name for name in MODULES if name.endswith('.__init__')])
def test_every_wing_says_in_one_sentence_what_it_holds(module: str) -> None:
    text = ast.get_docstring(parsed(module))
    assert text is not None
    assert text.endswith('.')
    assert '\n' not in text


def test_modules_import_from_other_wings_what_these_export() -> None:
    past_the_wing = {
        f'{importer} imports {imported}'
        for importer, imported in imports_across_wings()
        if imported not in IMPORTED_BY_NAME and not importer.endswith('__init__')
    }
    assert past_the_wing == set()


def test_no_two_classes_share_a_name() -> None:
    places: dict[str, list[str]] = defaultdict(list)
    for module in MODULES:
        for node in parsed(module).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith('_'):
                places[node.name].append(module)
    assert {name: where for name, where in places.items() if len(where) > 1} == {}


def test_what_is_imported_by_name_still_is() -> None:
    assert {imported for _, imported in imports_across_wings()} >= IMPORTED_BY_NAME


def test_a_tool_that_is_run_finds_what_it_imports_beside_itself() -> None:
    elsewhere = {
        f'{tool} imports {node.module}'
        for tool, path in TOOLS.items()
        for node in ast.walk(parsed(tool))
        if isinstance(node, ast.ImportFrom)
        and node.module in TOOLS
        and TOOLS[node.module].parent != path.parent
    }
    assert elsewhere == set()
