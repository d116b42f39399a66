"""Strict JSON for `--json`: NaN and infinities, which JSON lacks, become null."""

import json
import math
from typing import Any


def json_text(value: Any) -> str:
    """The object as indented JSON with a final newline."""
    return json.dumps(finite(value), indent=2, allow_nan=False) + '\n'


def finite(value: Any) -> Any:
    """The value with None in place of every number that is not finite."""
    if isinstance(value, dict):
        return {name: finite(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [finite(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
