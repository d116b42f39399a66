"""Parameters of the recorder, and the files that they name."""

import json
from dataclasses import dataclass
from pathlib import Path

from push_core.common import InputError, setting, validate


@dataclass(frozen=True)
class RecorderSettings:
    """Parameters of the recorder."""

    folder: str = setting('', 'new folder of the run')
    facts_file: str = setting('', 'JSON object with the facts of the run; empty for none')
    attachments: str = setting('', 'files to attach to the bag, one per line')
    topics: str = setting(
        '', 'more topics to record: names or patterns (/arm/*), separated by commas'
    )
    poll_period: float = setting(
        0.02, 'time between two polls for messages', unit='s', low=0.001, high=0.1
    )
    flush_period: float = setting(
        0.25,
        'time between two chunks; a kill loses at most this and poll_period',
        unit='s',
        low=0.05,
        high=10.0,
    )
    lost_warn: int = setting(
        1, 'lost messages from which /diagnostics has a warning', low=1, high=10**9
    )

    def __post_init__(self) -> None:
        validate(self)


def split_list(text: str) -> list[str]:
    """The non-empty parts of a text separated by commas."""
    return [part.strip() for part in text.split(',') if part.strip()]


def read_facts(path: str) -> dict[str, str]:
    """Reads the facts of a run from a JSON object.

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
    """Contents of the files to attach, by name.

    Raises:
        InputError: one of them cannot be read, or two have the same name.
    """
    contents: dict[str, bytes] = {}
    for path in paths:
        name = Path(path).name
        if name in contents:
            raise InputError(f'{path}: two attachments have the name {name}')
        contents[name] = _content(path)
    return contents


def _content(path: str) -> bytes:
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise InputError(f'{path}: {error.strerror}') from None
