"""Solvers that fail, and model servers that answer late or nonsense."""

import random

from push_msgs.srv import AddPushes
from push_node import interface

from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault, Outcome
from push_bringup.faults.injections import BOTH, FOR_GOOD, Inject, wait_out

PUSH = 0.004  # [m], parameter distance of gp_server
POISONED = 10.0  # [s] in which a wrong model loses the object


def _sick(how: str, duration: float) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        bed.make_sick(how)
        wait_out(bed, duration)
        bed.make_sick('')
        return duration

    return inject


def _learn(how: str, duration: float = 2.0) -> Inject:
    """The server is sick while a model that has grown is announced."""

    def inject(bed: Bed, chance: random.Random) -> float:
        bed.make_sick(how)
        p_y, beta = chance.uniform(-0.04, 0.04), chance.uniform(0.5, 2.5)
        request = AddPushes.Request(p_y=[p_y], beta=[beta], distance=PUSH)
        request.displacement = [0.003, 0.0, 0.0]
        client = interface.ADD_PUSHES.client(bed.node)
        bed.wait(client.service_is_ready, 5.0)
        client.call_async(request)
        bed.wait(lambda: bed.ended, duration)
        bed.make_sick('')
        return duration

    return inject


def _failing(how: str, text: str) -> Fault:
    inject = _sick(how, FOR_GOOD)
    text = f'every QP: the solver {text}'
    return Fault(text, Outcome.STOPS, inject, 'solver', modes=BOTH, sick=('mpc_node',))


def _answering(how: str, text: str) -> Fault:
    text = f'a model that has grown is announced, and the server {text}'
    return Fault(text, Outcome.CONTINUES, _learn(how), sick=('gp_server',))


SICK_FAULTS: dict[str, Fault] = {
    'solver_infeasible': _failing('infeasible', 'says that it is infeasible'),
    'solver_unfinished': _failing('unfinished', 'stops at its iteration limit without an input'),
    'solver_raises': _failing('raises', 'raises an exception'),
    'solver_slow': Fault(
        'every QP takes 20 ms', Outcome.CONTINUES, _sick('slow', 2.0), sick=('mpc_node',)
    ),
    'server_silent': _answering('silent', 'does not answer'),
    'server_late': _answering('late', 'answers each request 0.3 s late'),
    'server_nonsense': _answering('nonsense', 'answers NaN'),
    'server_huge': _answering('huge', 'answers 1e300'),
    'server_short': _answering('short', 'answers half of each request'),
    'server_poison': Fault(
        'a model that has grown is announced, with left and right exchanged',
        Outcome.STOPS,
        _learn('poison', POISONED),
        'the object',
        POISONED,
        sick=('gp_server',),
        breaks=True,
    ),
}
