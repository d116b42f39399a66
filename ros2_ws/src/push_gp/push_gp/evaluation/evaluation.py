"""Errors of one model on one file of pushes."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from push_core.common import InputError
from push_core.data import Accuracy, EndErrors, LongPushes, PushSet, accuracy, per_output
from push_core.geometry import Array

from push_gp.evaluation.rollout import rolled_out
from push_gp.evaluation.uncertainty import UncertaintyScore, score_uncertainty
from push_gp.models import GpModel, PushModel


@dataclass(frozen=True)
class Evaluation:
    """Errors of a model on short pushes.

    Attributes:
        model_id: of the model.
        accuracy: of its mean.
        uncertainty: of its variances; None for a model without them.
        trained_on: number of these pushes in its training set; they make the errors too small.
    """

    model_id: str
    accuracy: Accuracy
    uncertainty: UncertaintyScore | None
    trained_on: int

    def as_json(self) -> dict[str, Any]:
        """The block of accuracy figures with `nlpd` and `coverage_95` (null without variances)."""
        block: dict[str, Any] = {**self.accuracy.as_json(), 'nlpd': None, 'coverage_95': None}
        if self.uncertainty is not None:
            block['nlpd'] = per_output(self.uncertainty.nlpd)
            block['coverage_95'] = per_output(self.uncertainty.coverage_95)
        return {'model': self.model_id, **block, 'trained_on': self.trained_on}


@dataclass(frozen=True)
class RolloutEvaluation:
    """Figures of a model rolled out along long pushes.

    Attributes:
        model_id: of the model.
        pushes: measured.
        errors: of the end poses of the model.
    """

    model_id: str
    pushes: LongPushes
    errors: EndErrors

    def as_json(self) -> dict[str, Any]:
        """End errors of the pushes that stay on the face, and of all."""
        everything = np.ones(len(self.pushes), dtype=bool)
        return {
            'model': self.model_id,
            'n': len(self.pushes),
            'rollout': {
                'on_face': self.errors.of(self.pushes.on_face),
                'all': self.errors.of(everything),
            },
        }


def rollout_evaluation(model: PushModel, pushes: LongPushes) -> RolloutEvaluation:
    """Rolls a model out along long pushes and compares their ends."""
    errors = pushes.errors(rolled_out(model, pushes))
    return RolloutEvaluation(model.info.model_id, pushes, errors)


def evaluate(model: PushModel, pushes: PushSet) -> Evaluation:
    """Compares a model with measured pushes.

    Raises:
        InputError: the pushes cover another distance than the model's.
    """
    if pushes.distance != model.distance:
        raise InputError(
            f'the model predicts pushes of {model.distance * 1e3:g} mm, '
            f'these are of {pushes.distance * 1e3:g} mm'
        )
    predicted, _ = model.evaluate(pushes.p_y, pushes.beta)
    errors = accuracy(predicted, pushes)
    shared = _shared(model.pushes, pushes) if isinstance(model, GpModel) else 0
    return Evaluation(model.info.model_id, errors, score_uncertainty(model, pushes), shared)


def _shared(training: PushSet, pushes: PushSet) -> int:
    known = {row.tobytes() for row in _rows(training)}
    return sum(row.tobytes() in known for row in _rows(pushes))


def _rows(pushes: PushSet) -> Array:
    return np.ascontiguousarray(np.column_stack((pushes.inputs, pushes.displacement)))
