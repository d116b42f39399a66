"""The conversation in which a model is tabulated, with models that answer for themselves."""

from collections.abc import Iterator

import numpy as np
import pytest
from push_mpc.table.domain import Domain
from push_mpc.table.tabulation import (
    CHECKS,
    GRIDS,
    MOST_AT_ONCE,
    TOLERANCE,
    ModelScope,
    Query,
    QueryResult,
    Tabulated,
    tabulation,
)

SIDE = 0.09
DATA = Domain.of_data((-0.04, 0.03), (0.3, 2.8), SIDE)


class Waves:
    """Smooth, with so many waves over the domain and a standard deviation."""

    def __init__(self, waves: float, deviation: float) -> None:
        self.waves, self.deviation = waves, deviation
        self.questions: list[Query] = []

    def answer(self, question: Query) -> QueryResult:
        self.questions.append(question)
        a, b = 60.0 * self.waves * question.p_y, 2.0 * self.waves * question.beta
        mean = np.repeat((np.sin(a) * np.sin(b))[:, None], 3, axis=1)
        slopes = np.stack([60.0 * np.cos(a) * np.sin(b), 2.0 * np.sin(a) * np.cos(b)], axis=-1)
        jacobian = np.repeat(self.waves * slopes[:, None, :], 3, axis=1)
        count = len(mean) if question.want_variance else 0
        return QueryResult(mean, jacobian, np.full((count, 3), self.deviation**2))


def tabulated(model: Waves, kind: str = 'gp', mean_function: str = 'zero') -> Tabulated:
    conversation = tabulation(ModelScope(DATA, kind, mean_function, SIDE))
    question = next(conversation)
    while True:
        try:
            question = conversation.send(model.answer(question))
        except StopIteration as done:
            return done.value


def errors(table: Tabulated, model: Waves) -> Iterator[float]:
    generator = np.random.default_rng(1)
    p_y, beta = generator.uniform(-0.04, 0.03, 3000), generator.uniform(0.3, 2.8, 3000)
    gap = table.table.evaluate(p_y, beta)[0] - model.answer(Query(p_y, beta)).mean
    yield from np.abs(gap).max(axis=0)


@pytest.mark.parametrize(('waves', 'size'), [(1.0, GRIDS[0]), (9.0, GRIDS[1]), (18.0, GRIDS[2])])
def test_the_table_is_refined_until_its_error_is_below_the_models_own_doubt(
    waves: float, size: tuple[int, int]
) -> None:
    model = Waves(waves, deviation=0.02)
    found = tabulated(model)
    assert found.size == size
    assert found.error <= TOLERANCE
    assert max(errors(found, model)) < 2.0 * TOLERANCE * model.deviation


def test_the_error_that_it_states_is_the_one_that_it_has() -> None:
    model = Waves(18.0, deviation=1e-4)
    found = tabulated(model)
    assert found.size == GRIDS[-1]
    assert found.error > TOLERANCE
    assert max(errors(found, model)) == pytest.approx(found.error * model.deviation, rel=0.5)
    assert 'standard deviations' in str(found)


def test_no_question_is_so_long_that_its_answer_holds_up_the_loop() -> None:
    model = Waves(18.0, deviation=0.02)
    tabulated(model)
    assert max(question.p_y.size for question in model.questions) <= MOST_AT_ONCE
    assert [question.want_variance for question in model.questions].count(True) == 1


def test_a_model_without_variance_is_asked_for_none_and_told_apart() -> None:
    model = Waves(18.0, deviation=0.0)
    found = tabulated(model, kind='analytical', mean_function='analytical')
    assert found.size == GRIDS[0]
    assert not any(question.want_variance for question in model.questions)
    assert 'has no variance' in str(found)


def test_a_model_over_the_cone_is_tabulated_over_the_whole_face() -> None:
    model = Waves(1.0, deviation=0.02)
    found = tabulated(model, mean_function='analytical')
    beyond = np.array([0.044]), np.array([0.1])
    truth = model.answer(Query(*beyond)).mean
    assert np.allclose(found.table.evaluate(*beyond)[0], truth, atol=1e-3)
    assert not found.data.covers(0.044, 0.1)


def test_the_domain_of_the_data_knows_what_lies_outside() -> None:
    assert DATA.covers(-0.04, 0.3)
    assert DATA.covers(0.0, 1.5)
    for p_y, beta in ((-0.041, 1.5), (0.031, 1.5), (0.0, 0.29), (0.0, 2.81)):
        assert not DATA.covers(p_y, beta)


def test_even_one_push_spans_a_domain() -> None:
    found = Domain.of_data((0.01, 0.01), (1.5, 1.5), SIDE)
    grid = found.grid((3, 3))
    assert np.all(np.diff(grid.p_y) > 0.0)
    assert np.all(np.diff(grid.beta) > 0.0)


def test_the_places_that_are_checked_are_inside_and_all_different() -> None:
    p_y, beta = DATA.scattered(CHECKS)
    assert all(map(DATA.covers, p_y, beta))
    assert len({*zip(p_y.tolist(), beta.tolist(), strict=True)}) == CHECKS
