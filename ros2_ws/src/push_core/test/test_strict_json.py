import json
import math

from push_core.common.strict_json import json_text


def test_what_is_no_number_is_null_at_any_depth() -> None:
    told = {'rows': [{'median': math.nan, 'n': 3}, (math.inf, 1.5)], 'worst': -math.inf}
    text = json_text(told)
    assert json.loads(text) == {'rows': [{'median': None, 'n': 3}, [None, 1.5]], 'worst': None}
    assert text.endswith('}\n')
