"""The pages agree with the tree: links, paths, the table of wings."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCES = ROOT / 'ros2_ws' / 'src'
PAGES = [*ROOT.glob('*.md'), *(ROOT / 'docs').glob('*.md'), *SOURCES.glob('*/README.md')]
WRITTEN = [page for page in PAGES if page.name not in ('parameters.md', 'results.md')]
ARCHITECTURE = (ROOT / 'docs' / 'architecture.md').read_text(encoding='utf-8')


def source(path: str) -> Path:
    """The place that `PACKAGE/wing/module.py` stands for."""
    package, _, rest = path.partition('/')
    inside = SOURCES / package / package / rest
    return inside if inside.exists() else SOURCES / package / rest


def wings() -> dict[str, str]:
    """Package and wing to the sentence in its `__init__.py`."""
    found = {}
    for init in SOURCES.glob('push_*/push_*/*/__init__.py'):
        text = ast.get_docstring(ast.parse(init.read_text(encoding='utf-8')))
        found[f'`{init.parts[-3]}` | `{init.parts[-2]}`'] = str(text)
    return found


def test_the_table_of_wings_has_every_wing_with_its_own_sentence() -> None:
    rows = re.findall(r'^\| (`push_\w+` \| `\w+`) \| (.+?) \|$', ARCHITECTURE, re.MULTILINE)
    assert dict(rows) == wings()


def test_the_paths_of_the_architecture_are_there() -> None:
    paths = re.findall(r'`((?:push_\w+/)?\w+/\w+\.py)`', ARCHITECTURE)
    paths += re.findall(r'`(push_\w+/[\w/]+\.py)`', ARCHITECTURE)
    whole = {path if path.startswith('push_') else f'push_mpc/{path}' for path in paths}
    assert sorted(path for path in whole if not source(path).is_file()) == []
    assert len(whole) > 40


@pytest.mark.parametrize('page', PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_links_of_a_page_lead_somewhere(page: Path) -> None:
    links = re.findall(r'\]\(([^)#\s]+)[^)]*\)', page.read_text(encoding='utf-8'))
    local = [link for link in links if '://' not in link]
    assert [link for link in local if not (page.parent / link).exists()] == []


@pytest.mark.parametrize('page', WRITTEN, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_prose_of_a_page_fits_a_screen(page: Path) -> None:
    lines = page.read_text(encoding='utf-8').splitlines()
    shown = [re.sub('<!--.*?-->', '', line) for line in lines]
    prose = [line for line in shown if not line.startswith(('|', '    ', '!['))]
    assert [line for line in prose if len(line) > 112] == []


def commands() -> Iterator[tuple[str, str, str, str]]:
    """Page, package, executable and arguments of each command."""
    for page in PAGES:
        for line in page.read_text(encoding='utf-8').splitlines():
            for found in re.finditer(r'ros2 run (push_\w+) ([\w-]+)([^`#|]*)', line):
                yield page.name, *found.groups()


def test_the_commands_of_the_pages_exist_with_their_options() -> None:
    unknown = []
    for page, package, executable, rest in commands():
        setup = (SOURCES / package / 'setup.py').read_text(encoding='utf-8')
        sources = ''.join(
            path.read_text(encoding='utf-8')
            for folder in {package, 'push_core', 'push_node'}
            for path in (SOURCES / folder / folder).rglob('*.py')
        )
        if f"'{executable} = " not in setup:
            unknown.append(f'{page}: {package} {executable}')
        options = set(re.findall(r'(?<!\S)--([a-z][a-z-]+)', rest)) - {'ros-args', 'params-file'}
        unknown += [
            f'{page}: {executable} --{name}'
            for name in options
            if not re.search(f"'(--)?{name}'", sources)
        ]
    assert unknown == []
