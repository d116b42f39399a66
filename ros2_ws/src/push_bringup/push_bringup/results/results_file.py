"""results.json: the results of each benchmark, with what made it."""

import json
import platform
from collections.abc import Mapping
from datetime import datetime, timezone
from pathlib import Path
from typing import Any, TypeAlias

from push_core.common import InputError, json_text, write_atomically

from push_bringup.results.figures import figures
from push_bringup.setup import git_revision, processor, source_revision, versions

Results: TypeAlias = Mapping[str, Mapping[str, Any]]
"""Name of a section, to its `command`, `made` (see `provenance`) and `results` (JSON object)."""


def read_results(path: Path) -> Results:
    """The sections of a results file.

    Raises:
        InputError: it cannot be read or is not such a file.
    """
    try:
        sections: Results = json.loads(path.read_text(encoding='utf-8'))['sections']
    except OSError as error:
        raise InputError(f'cannot read {path}: {error.strerror}') from error
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f'{path}: is not a file of bench results') from error
    return sections


def write_results(path: Path, sections: Results) -> None:
    """Writes the sections, and the figures that documents can quote by name.

    Raises:
        InputError: the file cannot be written.
    """
    content = {'figures': figures(sections), 'sections': sections}
    write_atomically(path, json_text(content).encode())


def provenance() -> dict[str, Any]:
    """When and by what a section is made."""
    return {
        'date': f'{datetime.now(timezone.utc):%Y-%m-%d}',
        'git_revision': git_revision(),
        'source_revision': source_revision(),
        'processor': processor(),
        'python': platform.python_version(),
        'versions': versions(),
    }
