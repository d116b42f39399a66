"""What the recorder is told, and the run facts that it reads from files."""

import json
from dataclasses import dataclass
from pathlib import Path

from push_core.common import InputError, setting, validate


@dataclass(frozen=True)
class RecorderSettings:
    """Parameters of the recorder."""

    folder: str = setting('', 'new folder of the run')
    facts_file: str = setting('', 'JSON object with the facts of the run; empty for none')
    attachments: str = setting('', 'files to keep in the bag, one a line')
    topics: str = setting(
        '', 'topics or patterns (/arm/*) to record beside those of the cell, separated by commas'
    )
    poll_period: float = setting(
        0.02, 'time between two looks for new messages', unit='s', low=0.001, high=0.1
    )
    flush_period: float = setting(
        0.25,
        'time between two chunks: with poll_period what a kill can lose',
        unit='s',
        low=0.05,
        high=10.0,
    )

    def __post_init__(self) -> None:
        validate(self)


def split_list(text: str) -> list[str]:
    """The non-empty parts of a text separated by commas."""
    return [part.strip() for part in text.split(',') if part.strip()]


def read_facts(path: str) -> dict[str, str]:
    """The facts of a run from a file that holds one JSON object.

    Args:
        path: of the file; empty for no facts.

    Raises:
        InputError: the file cannot be read or holds something else.
    """
    if not path:
        return {}
    try:
        facts = json.loads(_content(path))
    except ValueError as error:
        raise InputError(f'{path} is not JSON: {error}') from None
    if not isinstance(facts, dict):
        raise InputError(f'{path} must hold one JSON object with the facts of the run')
    return {
        key: fact if isinstance(fact, str) else json.dumps(fact) for key, fact in facts.items()
    }


def read_attachments(paths: list[str]) -> dict[str, bytes]:
    """Files to keep in the bag, by name.

    Raises:
        InputError: one of them cannot be read, or two have the same name.
    """
    found: dict[str, bytes] = {}
    for path in paths:
        name = Path(path).name
        if name in found:
            raise InputError(f'{path}: another file to keep in the bag is called {name} as well')
        found[name] = _content(path)
    return found


def _content(path: str) -> bytes:
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise InputError(f'{path}: {error.strerror}') from None
