"""Models of a push: interface, motion cone, Gaussian processes, model files."""

from push_gp.models.analytical_model import ANALYTICAL, NOMINAL_DISTANCE, AnalyticalModel
from push_gp.models.gp_model import GpModel, residuals
from push_gp.models.mean_function import MEAN_FUNCTIONS, ConeMean, MeanFunction, ZeroMean
from push_gp.models.model import ModelInfo, PushModel
from push_gp.models.model_file import VERSION, load_model, model_named, save_model
from push_gp.models.sampling import Rows, five_push_rows, nested_rows, random_rows, subset_rows
from push_gp.models.sealed_archive import read_sealed
from push_gp.models.smooth_cone import SmoothCone

__all__ = [
    'ANALYTICAL',
    'MEAN_FUNCTIONS',
    'NOMINAL_DISTANCE',
    'VERSION',
    'AnalyticalModel',
    'ConeMean',
    'GpModel',
    'MeanFunction',
    'ModelInfo',
    'PushModel',
    'Rows',
    'SmoothCone',
    'ZeroMean',
    'five_push_rows',
    'load_model',
    'model_named',
    'nested_rows',
    'random_rows',
    'read_sealed',
    'residuals',
    'save_model',
    'subset_rows',
]
