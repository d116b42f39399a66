import pytest
from push_gp.learn import learned
from push_gp.model_file import save_model
from push_sim.collect import collect


@pytest.fixture(scope='session')
def model_file(tmp_path_factory):
    """A small learned model."""
    path = tmp_path_factory.mktemp('model') / 'model.npz'
    save_model(path, learned(collect(30, seed=0)))
    return path
