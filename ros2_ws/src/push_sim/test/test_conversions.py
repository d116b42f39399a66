"""Messages of the simulator node."""

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from push_msgs.msg import Perturbation as PerturbationMessage
from push_sim.node.conversions import perturbation_message
from push_sim.plant.perturbation import AppliedPerturbation
from push_sim.settings.plant_settings import PerturbationKind


@pytest.mark.parametrize('kind', PerturbationKind)
def test_a_perturbation_message_has_the_kind_of_the_applied_perturbation(kind) -> None:
    applied = AppliedPerturbation(1.5, kind, 0.02, np.array([0.6, -0.8]))
    message = perturbation_message(applied, Time(sec=1, nanosec=500_000_000))
    assert message.kind == getattr(PerturbationMessage, kind.name)
    assert (message.magnitude, message.direction.x, message.direction.y) == (0.02, 0.6, -0.8)
    assert (message.header.frame_id, message.header.stamp.sec) == ('world', 1)
