"""What a run needs before it starts: request, parameters, default model, run folder."""

from push_bringup.setup.cell_parameters import (
    PARAMETERS_FILE,
    CellParameters,
    installed_config,
    node_defaults,
    recorded_in,
    recorded_parameters,
    resolved,
)
from push_bringup.setup.default_model import default_model, model_for
from push_bringup.setup.effect import check_effective
from push_bringup.setup.provenance import (
    MODEL_SOURCES,
    code_key,
    git_revision,
    processor,
    source_revision,
    versions,
)
from push_bringup.setup.request import Request
from push_bringup.setup.run_folder import keep_logs, new_run_folder, write_inputs

__all__ = [
    'MODEL_SOURCES',
    'PARAMETERS_FILE',
    'CellParameters',
    'Request',
    'check_effective',
    'code_key',
    'default_model',
    'git_revision',
    'installed_config',
    'keep_logs',
    'model_for',
    'new_run_folder',
    'node_defaults',
    'processor',
    'recorded_in',
    'recorded_parameters',
    'resolved',
    'source_revision',
    'versions',
    'write_inputs',
]
