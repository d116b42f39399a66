import os
import signal

import pytest
from push_core.common.workers import worker_pool

LARGE, SMALL = range(20_000_000), range(3)


def test_several_processes_give_results_in_order_or_as_they_are_done() -> None:
    tasks = [(LARGE,), (SMALL,)]
    with worker_pool(2) as pool:
        assert list(pool.in_order(sum, tasks)) == [sum(LARGE), 3]
        assert list(pool.as_done(sum, tasks)) == [3, sum(LARGE)]


def test_one_job_runs_in_this_process() -> None:
    with worker_pool(1) as pool:
        assert list(pool.in_order(os.getpid, [()])) == [os.getpid()]


def test_ctrl_c_is_left_to_this_process_and_an_error_ends_the_workers() -> None:
    with pytest.raises(KeyboardInterrupt), worker_pool(2) as pool:
        worker = next(pool.in_order(os.getpid, [()]))
        os.kill(worker, signal.SIGINT)
        assert next(pool.in_order(sum, [(SMALL,)])) == 3
        raise KeyboardInterrupt
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)
