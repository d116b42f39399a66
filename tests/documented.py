"""The commands that README and docs show: code blocks, and the rows of README's table of tasks.

Marks stand on lines before the block, with a blank line between, or in the row:

- `<!-- not run: REASON -->`: no test can run it.
- `<!-- slow: REASON -->`: it is run only where the environment has SLOW=yes.
- `<!-- with: NAME=VALUE ... -->`: run with these options, which shorten it or make it independent
  of the clock. A mark in a row must not hold two dashes.
- `<!-- beside: COMMAND; ... -->`: these nodes run meanwhile.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGES = [
    ROOT / 'README.md',
    ROOT / 'CONTRIBUTING.md',
    *sorted((ROOT / 'docs').glob('*.md')),
    *sorted((ROOT / 'ros2_ws/src').glob('*/README.md')),
]
MARK = re.compile(r'<!-- (not run|slow|with|beside): (.+?) -->')
# marks and blank lines, then lines that are indented after a blank one, or a fence
BLOCK = re.compile(
    r'(?P<marks>(?:^ *<!-- .*-->\n\n)*)'
    r'(?:(?<=\n\n)(?P<indented>(?:^ {4,}\S.*\n|^\n(?= {4}))+)'
    r'|^```(?P<language>\w*)\n(?P<fenced>(?:(?!```).*\n)*)```)',
    re.MULTILINE,
)


@dataclass(frozen=True)
class Shown:
    """Commands that stand together.

    Attributes:
        place: page and line.
        commands: one a line, options in brackets among them.
        not_run: why no test can run them; empty if one can.
        slow: why only SLOW=yes runs them; may be empty.
        options: that the test adds to each command, as --NAME=VALUE.
        beside: commands of nodes that have to run meanwhile.
    """

    place: str
    commands: tuple[str, ...]
    not_run: str = ''
    slow: str = ''
    options: str = ''
    beside: tuple[str, ...] = ()

    @classmethod
    def at(cls, place: str, lines: list[str], marks: list[tuple[str, str]]) -> 'Shown':
        """Lines as they stand on a page, with their marks."""
        of = dict(marks)
        return cls(
            place,
            tuple(command_of(line) for line in lines if line.strip()),
            of.get('not run', ''),
            of.get('slow', ''),
            ''.join(f' --{option}' for option in of.get('with', '').split()),
            tuple(filter(None, of.get('beside', '').split('; '))),
        )

    @property
    def is_marked(self) -> bool:
        """Whether the page says something of how it is run."""
        return bool(self.not_run or self.slow or self.options or self.beside)


def shown() -> list[Shown]:
    """All of them; the rows of the table only where no block that is run begins with the same."""
    blocks = [block for page in PAGES for block in blocks_of(page)]
    run = [command for block in blocks if not block.not_run for command in block.commands]

    def is_run(command: str) -> bool:
        return any(longer.startswith(command) for longer in run)

    return blocks + [row for row in rows() if row.is_marked or not all(map(is_run, row.commands))]


def blocks_of(page: Path) -> Iterator[Shown]:
    """Indented blocks, and fenced ones in `sh`; those in no language are drawings and output."""
    text = page.read_text(encoding='utf-8')
    for block in BLOCK.finditer(text):
        if block['indented'] or block['language'] == 'sh':
            lines = (block['indented'] or block['fenced']).splitlines()
            yield Shown.at(place_of(page, text, block), lines, MARK.findall(block['marks']))


def languages() -> Iterator[tuple[str, str]]:
    """Page and language of each fenced block."""
    for page in PAGES:
        for block in BLOCK.finditer(page.read_text(encoding='utf-8')):
            if block['fenced'] is not None:
                yield page.name, block['language']


def rows() -> Iterator[Shown]:
    """The rows of `Commands by task`, where `…` stands for `ros2 run push_bringup`."""
    page = ROOT / 'README.md'
    text = page.read_text(encoding='utf-8')
    for row in re.finditer(r'^\|.*`(?:ros2 run|…) .*\|$', text, re.MULTILINE):
        cell = row[0].split(' | ')[1]
        commands = re.findall(r'`((?:ros2 run|…) [^`]+)`', cell)
        yield Shown.at(place_of(page, text, row), commands, MARK.findall(cell))


def place_of(page: Path, text: str, found: re.Match[str]) -> str:
    return f'{page.relative_to(ROOT)}:{text.count(chr(10), 0, found.start()) + 1}'


def command_of(line: str) -> str:
    """Without its comment, and with its optional arguments."""
    command = re.sub(r'\s+#.*', '', line).strip().replace('…', 'ros2 run push_bringup')
    return re.sub(r'\[(--[^\]]*)\]', r'\1', command)
