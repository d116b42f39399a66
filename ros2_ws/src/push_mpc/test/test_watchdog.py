from push_mpc.node.watchdog import Watchdog


def test_a_process_that_looks_in_time_never_slept() -> None:
    watchdog = Watchdog(0.01)
    assert not any(watchdog.slept(now) for now in (5.0, 5.01, 5.021, 5.03))


def test_after_a_freeze_one_look_is_let_pass_and_no_more() -> None:
    watchdog = Watchdog(0.01)
    watchdog.slept(5.0)
    assert watchdog.slept(5.06)
    assert not watchdog.slept(5.07)
