"""How well a run knew how well it predicted the next pose."""

import pytest
from push_bag.score import score_run


def test_stated_deviations_that_are_right_cover_95_percent(perfect):
    found = score_run(perfect)['prediction']
    assert found['poses'] > 100
    for name in ('x', 'y'):
        assert found['coverage_95'][name] == pytest.approx(0.95, abs=0.02)
        assert found['deviations_95'][name] == pytest.approx(1.96, abs=0.25)


def test_innovations_twice_as_large_as_stated_need_a_bound_twice_as_wide(perfect):
    found = score_run(perfect)['prediction']
    assert found['coverage_95']['heading'] == pytest.approx(0.67, abs=0.03)
    assert found['deviations_95']['heading'] == pytest.approx(
        2.0 * found['deviations_95']['x'], rel=1e-6
    )
