"""What `--json` prints: JSON that every parser takes, with null where a number does not exist."""

import json
import math
from typing import Any


def json_text(value: Any) -> str:
    """An object as JSON that ends its line; NaN and the infinities, which JSON lacks, as null."""
    return json.dumps(finite(value), indent=2, allow_nan=False) + '\n'


def finite(value: Any) -> Any:
    """The same value with None in the place of every number that is not finite."""
    if isinstance(value, dict):
        return {name: finite(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [finite(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
