import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from push_node.diagnostics import ERROR, OK, WARN, Reporter, above, status_name, worst


def test_the_worst_finding_counts_with_all_messages_of_its_level() -> None:
    assert worst([], 'running') == (OK, 'running')
    assert worst([(ERROR, '')], 'running') == (OK, 'running')
    findings = [(WARN, 'slow'), (ERROR, 'no poses'), (ERROR, 'no model'), (WARN, '')]
    assert worst(findings, 'running') == (ERROR, 'no poses; no model')


@pytest.mark.parametrize(
    ('value', 'finding'), [(1.0, (WARN, '')), (2.0, (WARN, 'x')), (9.0, (ERROR, 'x'))]
)
def test_thresholds_make_levels(value, finding) -> None:
    assert above(value, 1.0, 5.0, 'x') == finding


@pytest.mark.processes
def test_a_report_arrives_on_diagnostics_under_the_name_of_its_node(made_node, spun_until) -> None:
    reported: list[DiagnosticArray] = []
    node, listener = made_node(namespace='/cell_1'), made_node('listener')
    listener.create_subscription(DiagnosticArray, '/diagnostics', reported.append, 10)
    reporter = Reporter(node, 'control')
    spun_until(listener, lambda: node.count_subscribers('/diagnostics') > 0)
    listener.create_timer(0.05, lambda: reporter.report(ERROR, 'no pose', {'ticks': '7'}))
    spun_until(listener, lambda: bool(reported))
    status = reported[0].status[0]
    assert status.name == status_name('/cell_1/tested', 'control') == '/cell_1/tested: control'
    assert (status.level, status.message) == (DiagnosticStatus.ERROR, 'no pose')
    assert {pair.key: pair.value for pair in status.values} == {'ticks': '7'}
    assert reported[0].header.stamp.sec > 0


@pytest.mark.processes
def test_a_good_report_is_ok(made_node, spun_until) -> None:
    reported: list[DiagnosticArray] = []
    node = made_node()
    node.create_subscription(DiagnosticArray, '/diagnostics', reported.append, 10)
    reporter = Reporter(node, 'control')
    node.create_timer(0.05, lambda: reporter.report(OK, 'ready', {}))
    spun_until(node, lambda: bool(reported))
    assert reported[0].status[0].level == DiagnosticStatus.OK
