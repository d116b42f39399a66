import numpy as np
from push_core.data.push_set import HALF_FACE
from push_gp.models.sampling import spread_rows


def test_of_the_two_closest_the_older_goes() -> None:
    inputs = np.array([[0.0, 1.0], [0.01, 2.0], [0.0, 1.01], [-0.02, 0.5]])
    assert spread_rows(inputs, 3).tolist() == [1, 2, 3]


def test_half_a_face_counts_as_much_as_a_radian() -> None:
    inputs = np.array([[0.0, 1.0], [0.1 * HALF_FACE, 1.0], [0.0, 2.0], [0.0, 2.09]])
    assert spread_rows(inputs, 3).tolist() == [0, 1, 3]


def test_what_repeats_goes_and_the_domain_stays_covered() -> None:
    grid = np.array([[y, beta] for y in (-0.04, 0.0, 0.04) for beta in (0.5, 1.5, 2.5)])
    again = np.repeat(grid[4:5], 30, axis=0) + np.linspace(0.0, 1e-4, 30)[:, None]
    kept = spread_rows(np.vstack((grid, again)), 9)
    assert kept.tolist() == [0, 1, 2, 3, 5, 6, 7, 8, 38]


def test_few_enough_pushes_all_stay() -> None:
    assert spread_rows(np.zeros((3, 2)), 3).tolist() == [0, 1, 2]
    assert spread_rows(np.zeros((3, 2)), 1).tolist() == [2]
