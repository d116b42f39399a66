import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from push_node.diagnostics import Reporter, status_name

pytestmark = pytest.mark.processes


def test_a_report_arrives_on_diagnostics_under_the_name_of_its_node(made_node, spun_until) -> None:
    reported: list[DiagnosticArray] = []
    node, listener = made_node(namespace='/cell_1'), made_node('listener')
    listener.create_subscription(DiagnosticArray, '/diagnostics', reported.append, 10)
    reporter = Reporter(node, 'control')
    spun_until(listener, lambda: node.count_subscribers('/diagnostics') > 0)
    listener.create_timer(0.05, lambda: reporter.report(False, 'no pose', {'ticks': '7'}))
    spun_until(listener, lambda: bool(reported))
    status = reported[0].status[0]
    assert status.name == status_name('/cell_1/tested', 'control') == '/cell_1/tested: control'
    assert (status.level, status.message) == (DiagnosticStatus.ERROR, 'no pose')
    assert {pair.key: pair.value for pair in status.values} == {'ticks': '7'}
    assert reported[0].header.stamp.sec > 0


def test_a_good_report_is_ok(made_node, spun_until) -> None:
    reported: list[DiagnosticArray] = []
    node = made_node()
    node.create_subscription(DiagnosticArray, '/diagnostics', reported.append, 10)
    reporter = Reporter(node, 'control')
    node.create_timer(0.05, lambda: reporter.report(True, 'ready', {}))
    spun_until(node, lambda: bool(reported))
    assert reported[0].status[0].level == DiagnosticStatus.OK
