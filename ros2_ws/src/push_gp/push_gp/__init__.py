"""The model: Gaussian processes over contact point and push direction, and their server."""

from typing import TYPE_CHECKING

from push_core.lazy import lazy_exports

if TYPE_CHECKING:
    from push_gp.evaluation import Evaluation as Evaluation
    from push_gp.evaluation import evaluate as evaluate
    from push_gp.models import AnalyticalModel as AnalyticalModel
    from push_gp.models import GpModel as GpModel
    from push_gp.models import ModelInfo as ModelInfo
    from push_gp.models import PushModel as PushModel
    from push_gp.models import load_model as load_model
    from push_gp.models import random_rows as random_rows
    from push_gp.models import save_model as save_model
    from push_gp.training.train import train as train
else:
    __getattr__, __dir__, __all__ = lazy_exports(
        __name__,
        {
            'evaluation': ['Evaluation', 'evaluate'],
            'models': [
                'AnalyticalModel',
                'GpModel',
                'ModelInfo',
                'PushModel',
                'load_model',
                'random_rows',
                'save_model',
            ],
            'training.train': ['train'],
        },
    )
