import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.data.push_set import PushSet
from push_gp.models.sampling import five_push_rows, nested_rows, random_rows, subset_rows


def test_a_random_choice_depends_on_the_seed_alone(pushes: PushSet) -> None:
    assert np.array_equal(random_rows(pushes, 20, 3), random_rows(pushes, 20, 3))
    assert not np.array_equal(random_rows(pushes, 20, 3), random_rows(pushes, 20, 4))
    assert len(set(random_rows(pushes, 20, 3).tolist())) == 20


def test_nested_choices_are_part_of_larger_ones_and_others_are_not(pushes: PushSet) -> None:
    assert set(nested_rows(pushes, 10, 3)) < set(nested_rows(pushes, 20, 3))
    assert not set(random_rows(pushes, 10, 3)) < set(random_rows(pushes, 20, 3))


@pytest.mark.parametrize('points', [0, -1, 61])
def test_no_more_pushes_are_chosen_than_there_are(pushes: PushSet, points: int) -> None:
    with pytest.raises(InputError, match='of 60 pushes'):
        random_rows(pushes, points, 0)
    with pytest.raises(InputError, match='of 60 pushes'):
        nested_rows(pushes, points, 0)


def test_a_subset_is_the_rows_that_its_column_names() -> None:
    some = np.array([True, False, True])
    zeros = np.zeros(3)
    pushes = PushSet(
        zeros, zeros + 1, np.zeros((3, 3)), 0.004, {'subset_2': some, 'subset_0': ~(some | True)}
    )
    assert subset_rows(pushes, 'subset_2').tolist() == [0, 2]
    with pytest.raises(InputError, match='empty'):
        subset_rows(pushes, 'subset_0')
    with pytest.raises(InputError, match='the file has: subset_2, subset_0'):
        subset_rows(pushes, 'subset_9')


def test_the_five_of_a_die_is_found_among_the_pushes() -> None:
    p_y = np.array([0.03, 0.0, -0.0225, 0.0225, -0.0225, 0.0225, 0.04])
    beta = np.radians([90, 90, 60, 60, 120, 120, 30])
    pushes = PushSet(p_y, beta, np.zeros((7, 3)), 0.004)
    assert five_push_rows(pushes).tolist() == [1, 2, 3, 4, 5]
    with pytest.raises(InputError, match='needs 5 pushes'):
        five_push_rows(pushes.take(np.arange(4)))


def test_the_five_of_a_die_are_five_even_where_all_pushes_are_alike() -> None:
    pushes = PushSet(np.zeros(6), np.ones(6), np.zeros((6, 3)), 0.004)
    assert sorted(five_push_rows(pushes).tolist()) == [0, 1, 2, 3, 4]
