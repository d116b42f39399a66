"""The folder of one run: its name and the files kept with the recording."""

import json
import os
import platform
import shutil
from datetime import datetime, timezone
from pathlib import Path

import numpy as np
from push_core.common import InputError
from push_gp.models import ANALYTICAL, read_sealed
from push_mpc.plan import Plan

from push_bringup.setup.cell_parameters import CellParameters
from push_bringup.setup.provenance import git_revision, processor, source_revision, versions
from push_bringup.setup.request import Request

PLAN_FILE = 'nominal_trajectory.csv'
PLAN_COLUMNS = 't_s,x_m,y_m,theta_rad,p_y_m,v_n_m_s,v_t_m_s'


def new_run_folder(request: Request, now: datetime) -> Path:
    """A name for the run in the output folder; the recorder makes the folder itself.

    Raises:
        InputError: the output folder cannot be written to.
    """
    output = request.output
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f'{output}: {error.strerror}; name another folder with -o') from error
    if not os.access(output, os.W_OK):
        raise InputError(f'{output}: not writable; name another folder with -o')
    track = Path(request.track).stem
    name = f'{now:%Y%m%d-%H%M%S}_{track}_{request.controller}_{1e3 * request.speed:.0f}mms'
    return _unused(output / name)


def _unused(folder: Path) -> Path:
    number, unused = 1, folder
    while unused.exists():
        number += 1
        unused = folder.with_name(f'{folder.name}_{number}')
    return unused


def write_inputs(request: Request, parameters: CellParameters, plan: Plan, inputs: Path) -> None:
    """Writes the files that the recorder attaches to the bag into a folder."""
    columns = np.column_stack([plan.time, plan.state, plan.input])
    np.savetxt(inputs / PLAN_FILE, columns, '%.9g', ',', header=PLAN_COLUMNS, comments='')
    (inputs / 'params.yaml').write_text(parameters.as_yaml(), encoding='utf-8')
    (inputs / 'facts.json').write_text(json.dumps(facts(request), indent=1), encoding='utf-8')


def keep_logs(inputs: Path, folder: Path) -> None:
    """Copies the output of the nodes to the run folder; on a full disk none of it."""
    logs = sorted(inputs.glob('*.log'))
    if not (logs and folder.is_dir()):
        return
    try:
        (folder / 'log').mkdir()
        for log in logs:
            shutil.copyfile(log, folder / 'log' / log.name)
    except OSError:
        # the reason of the end is still to be reported, and matters more
        shutil.rmtree(folder / 'log', ignore_errors=True)


def facts(request: Request) -> dict[str, str]:
    """What is needed to repeat the run, in addition to parameters and model file."""
    return {
        'track': request.track,
        'speed': f'{request.speed:g}',
        'controller': request.controller,
        'profile': request.profile,
        'perturb': request.perturb,
        'laps': str(request.laps),
        'seed': str(request.seed),
        'mode': request.mode,
        'started': datetime.now(timezone.utc).isoformat(timespec='seconds'),
        'machine': f'{processor()}, {platform.platform()}',
        'python': platform.python_version(),
        'versions': json.dumps(versions()),
        'git_revision': git_revision(),
        'source_revision': source_revision(),
        **_model_facts(request.model),
    }


def _model_facts(model: str) -> dict[str, str]:
    """Hashes of model and training set."""
    if model == ANALYTICAL:
        return {'model_hash': ANALYTICAL, 'training_set_hash': ''}
    header, _ = read_sealed(Path(model))
    return {
        'model_hash': str(header.get('model_sha256', '')),
        'training_set_hash': str(header.get('training_set_sha256', '')),
    }
