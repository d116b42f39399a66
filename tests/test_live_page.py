"""The live page in a browser, beside a cell whose nodes run."""

import shutil
import signal
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from graph_by_hand import GraphByHand
from push_node import interface

BROWSER = shutil.which('chromium') or shutil.which('google-chrome')
QUIET = ('--no-sandbox', '--disable-gpu', '--disable-background-networking', '--no-first-run')
PATIENCE = 60.0  # [s]; nothing but a hang takes that long
LOCKSTEP = 'mode:=lockstep'

pytestmark = pytest.mark.processes


@pytest.fixture(scope='module')
def served(environment: dict[str, str]) -> Iterator[Callable[..., str]]:
    """Starts the live view with options; the address of its page."""
    started: list[subprocess.Popen[str]] = []

    def serve(*options: str) -> str:
        ports = ('--ros-args', '-p', 'port:=0', '-p', 'page_port:=0')
        command = [sys.executable, '-m', 'push_bag.commands.live', *options, *ports]
        started.append(
            subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)
        )
        assert started[-1].stderr is not None
        return 'http://' + started[-1].stderr.readline().split('http://')[1].split()[0]

    yield serve
    for process in started:
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=PATIENCE) == 0


@pytest.fixture(scope='module')
def cell(environment: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A cell in lockstep that has been started once and stands still."""
    folder: Path = tmp_path_factory.mktemp('cell')
    graph = GraphByHand(environment, folder)
    graph.start('sim_node', LOCKSTEP)
    graph.start('gp_server', 'model:=analytical')
    options = ('track:=eight', 'laps:=20', 'controller:=analytical', 'require_recorder:=false')
    graph.start('mpc_node', LOCKSTEP, *options)
    for service in (interface.RESET_TO_PLAN, interface.START, interface.STOP, interface.RESUME):
        graph.call_until_success(service)
    yield
    graph.close()


@pytest.fixture(scope='module')
def complaints() -> list[str]:
    """What the page writes to the browser's console, and what it loads from elsewhere."""
    return []


@pytest.fixture(scope='module')
def page(cell: None, served: Callable[..., str], complaints: list[str]) -> Iterator[Any]:
    """The page with buttons."""
    if BROWSER is None:
        pytest.skip('no chromium; Debian has a package of it')
    playwright = pytest.importorskip('playwright.sync_api', reason='no playwright to drive it')
    address = served('--control')
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=BROWSER, args=list(QUIET))
        page = browser.new_page(viewport={'width': 1280, 'height': 900})
        page.set_default_timeout(1e3 * PATIENCE)
        page.on('console', lambda message: complaints.append(message.text))
        page.on('pageerror', lambda error: complaints.append(str(error)))
        own = (address, 'data:', 'blob:')
        page.on(
            'request',
            lambda request: complaints.extend(
                [] if request.url.startswith(own) else [request.url]
            ),
        )
        page.goto(address)
        yield page
        browser.close()


def mode(page: Any, expected: str) -> None:
    """Waits until the page shows a mode."""
    page.wait_for_function(f'document.getElementById("mode").textContent === "{expected}"')


def points(page: Any, figure: str, trace: int) -> int:
    """How many points a trace has that are numbers."""
    values = page.evaluate(f'document.getElementById("{figure}").data[{trace}].y')
    return sum(value is not None for value in values)


def begin(page: Any) -> None:
    """Presses the buttons that begin a run until the tip moves."""
    answers: list[str] = []
    while 'armed' not in ''.join(answers[-1:]):
        assert len(answers) < 100, answers
        for button in ('resume', 'reset_to_plan', 'start'):
            page.click(f'#{button}')
            page.wait_for_function('document.getElementById("answer").textContent !== "…"')
            answers.append(page.text_content('#answer'))
        page.wait_for_timeout(200)
    mode(page, 'tracking')


def test_its_buttons_start_a_run_that_it_shows_as_it_goes(
    page: Any, complaints: list[str]
) -> None:
    begin(page)
    page.wait_for_function('Number(document.getElementById("reference_time").textContent) > 0.5')
    page.wait_for_function('document.getElementById("map").data !== undefined')
    assert float(page.text_content('#error')) < 5.0
    assert float(page.text_content('#speed')) > 10.0
    assert 'eight, 80 mm/s, analytical' in page.text_content('#title')
    page.wait_for_function('document.getElementById("map").data[3].y.length > 10')
    assert [points(page, 'map', trace) > 4 for trace in range(5)] == [True] * 5
    for figure, trace in (('errors', 0), ('errors', 1), ('velocities', 1), ('estimates', 2)):
        page.locator(f'#{figure}').scroll_into_view_if_needed()
        page.wait_for_function(f'(document.getElementById("{figure}").data || []).length > 0')
        page.wait_for_function(
            f'document.getElementById("{figure}").data[{trace}].y.some((y) => y !== null)'
        )
    assert complaints == []


def test_a_button_stops_it_and_it_says_why(page: Any) -> None:
    page.click('#stop')
    mode(page, 'stopped')
    assert page.text_content('#reason') == 'stopped on request'


def test_a_phone_shows_it_without_scrolling_sideways(page: Any) -> None:
    page.set_viewport_size({'width': 390, 'height': 844})
    page.reload()
    page.wait_for_function('document.getElementById("map").data !== undefined')
    assert page.evaluate('document.documentElement.scrollWidth') <= 390


def test_without_control_it_has_no_buttons_and_takes_no_commands(
    served: Callable[..., str],
) -> None:
    address = served()
    text = urllib.request.urlopen(address, timeout=PATIENCE).read().decode()
    assert '<button' not in text
    asked = urllib.request.Request(f'{address}/start', b'', {'X-Push-Control': '1'})
    with pytest.raises(urllib.error.HTTPError, match='403'):
        urllib.request.urlopen(asked, timeout=PATIENCE)


def test_no_page_of_another_origin_can_press_its_buttons(served: Callable[..., str]) -> None:
    asked = urllib.request.Request(f'{served("--control")}/start', b'')
    with pytest.raises(urllib.error.HTTPError, match='403'):
        urllib.request.urlopen(asked, timeout=PATIENCE)
