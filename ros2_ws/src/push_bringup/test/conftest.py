import pytest
from push_gp.models.model_file import save_model
from push_gp.training.train import train
from push_sim.collect import collect_pushes


@pytest.fixture(scope='session')
def pushes():
    """A small set of simulated pushes."""
    return collect_pushes(30, seed=0)


@pytest.fixture(scope='session')
def model_file(pushes, tmp_path_factory):
    """A small learned model."""
    path = tmp_path_factory.mktemp('model') / 'model.npz'
    save_model(path, train(pushes))
    return path
