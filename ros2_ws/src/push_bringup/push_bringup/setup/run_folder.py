"""The folder of one run: its name and the files kept with the recording."""

import json
import os
import platform
import re
import shutil
import unicodedata
from datetime import datetime, timezone
from pathlib import Path

import numpy as np
from push_core.common import InputError
from push_gp.models import ANALYTICAL, read_sealed
from push_mpc.plan import Plan
from push_mpc.settings import MpcSettings

from push_bringup.setup.cell_parameters import (
    FACTS_FILE,
    PARAMETERS_FILE,
    PLAN_FILE,
    CellParameters,
)
from push_bringup.setup.provenance import git_revision, processor, source_revision, versions
from push_bringup.setup.request import Request

_LONGEST_NAME = 60
PLAN_COLUMNS = 't_s,x_m,y_m,theta_rad,p_y_m,v_n_m_s,v_t_m_s'


def new_run_folder(output: Path, mpc: MpcSettings, now: datetime) -> Path:
    """A name for the run in the output folder; the recorder makes the folder itself.

    Args:
        output: folder of all runs.
        mpc: track, controller and speed of the run.
        now: local time.

    Raises:
        InputError: the output folder cannot be written to.
    """
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f'{output}: {error.strerror}; name another folder with -o') from error
    if not os.access(output, os.W_OK):
        raise InputError(f'{output}: not writable; name another folder with -o')
    track = plain_name(Path(mpc.track).stem)
    name = f'{now:%Y%m%d-%H%M%S}_{track}_{mpc.controller}_{1e3 * mpc.speed:g}mms'
    return _unused(output / name)


def plain_name(name: str) -> str:
    """A name that users give, as part of a file name: letters, digits, `-` and `_` of ASCII."""
    ascii_only = unicodedata.normalize('NFKD', name).encode('ascii', 'ignore').decode()
    return re.sub('[^A-Za-z0-9_-]+', '_', ascii_only).strip('_')[:_LONGEST_NAME] or 'track'


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
    (inputs / PARAMETERS_FILE).write_text(parameters.as_yaml(), encoding='utf-8')
    text = json.dumps(facts(request, parameters), indent=1)
    (inputs / FACTS_FILE).write_text(text, encoding='utf-8')


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


def facts(request: Request, parameters: CellParameters) -> dict[str, str]:
    """What is needed to repeat the run, in addition to parameters and model file."""
    sim, mpc = parameters.sim, parameters.mpc
    same = sim.profile == mpc.profile
    return {
        'track': mpc.track,
        'speed': f'{mpc.speed:g}',
        'controller': mpc.controller,
        'preset': mpc.preset,
        'profile': sim.profile if same else f'{sim.profile}, controller {mpc.profile}',
        'perturb': sim.perturbation.kind,
        'laps': str(mpc.laps),
        'learn': str(mpc.learn).lower(),
        **({'learn_from': str(request.learn_from)} if request.learn_from else {}),
        'seed': str(sim.seed),
        'mode': 'inprocess' if request.is_in_process else mpc.mode,
        'changed': parameters.changed(),
        'started': datetime.now(timezone.utc).isoformat(timespec='seconds'),
        'machine': f'{processor()}, {platform.platform()}',
        'python': platform.python_version(),
        'versions': json.dumps(versions()),
        'git_revision': git_revision(),
        'source_revision': source_revision(),
        **_model_facts(parameters.gp.model),
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
