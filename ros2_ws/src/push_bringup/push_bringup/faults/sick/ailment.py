"""How a process is told to be sick: one word in the file that an environment variable names."""

import os
from pathlib import Path

FAULT_FILE = 'PUSH_FAULT_FILE'


def ailment() -> str:
    """The word, empty while the process shall be well."""
    path = Path(os.environ.get(FAULT_FILE, ''))
    return path.read_text(encoding='utf-8').strip() if path.is_file() else ''
