"""Every message that docs/troubleshooting.md quotes is one that the sources write."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / 'docs' / 'troubleshooting.md').read_text(encoding='utf-8')
FIRST_COLUMN = re.compile(r'^\| ([^|]+) \|', re.MULTILINE)
SOURCES = [
    path.read_text(encoding='utf-8')
    for pattern in ('ros2_ws/src/*/push_*/**/*.py', 'scripts/**/*.sh', 'env.sh')
    for path in ROOT.glob(pattern)
]
# literals that stand next to each other, in quotes of Python or behind printf
TEXT = re.sub(r"'\s*\n\s*f?r?'|\{[^{}]*\}|%[ds]", '\0', '\n'.join(SOURCES))
TEXT = re.sub(r"'\s*\n?\s*f'|' '", '', TEXT).replace('\0', '')


def quotes() -> list[str]:
    cells = FIRST_COLUMN.findall(PAGE)
    return [quote for cell in cells for quote in re.findall(r'`([^`]+)`', cell)]


@pytest.mark.parametrize('quote', quotes())
def test_a_quoted_message_is_one_of_ours(quote: str) -> None:
    for piece in quote.split('…'):
        assert piece.strip(" ';,:") in TEXT, piece
