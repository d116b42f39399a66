import pytest
from push_gp.models.model_file import save_model
from push_gp.training.learn import learned
from push_sim.commands.collect import collect


@pytest.fixture(scope='session')
def pushes():
    """A small set of simulated pushes."""
    return collect(30, seed=0)


@pytest.fixture(scope='session')
def model_file(pushes, tmp_path_factory):
    """A small learned model."""
    path = tmp_path_factory.mktemp('model') / 'model.npz'
    save_model(path, learned(pushes))
    return path
