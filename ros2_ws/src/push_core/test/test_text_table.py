import pytest
from push_core.common.text_table import markdown_table, plain_table


def test_the_first_columns_are_aligned_left_and_numbers_right() -> None:
    rows = [('name', 'unit', 'value'), ('mass', 'kg', '0.8'), ('friction', '', '12.25')]
    assert plain_table(rows, left=2) == [
        'name      unit  value',
        'mass      kg      0.8',
        'friction        12.25',
    ]


def test_a_plain_table_needs_rows_of_one_length_and_may_be_empty() -> None:
    assert plain_table([]) == []
    with pytest.raises(ValueError, match='argument'):
        plain_table([('a', 'b'), ('c',)])


def test_a_markdown_table_has_a_rule_under_its_titles() -> None:
    assert markdown_table(('N', 'error'), [('5', '0.3 mm')]) == [
        '| N | error |',
        '|---|---|',
        '| 5 | 0.3 mm |',
    ]
