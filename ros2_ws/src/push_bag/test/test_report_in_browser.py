"""The report in a browser: opened, played, clicked."""

import shutil
import time
from collections.abc import Iterator

import pytest
from push_bag.report.report import REPORT_FILE, write_results

BROWSER = shutil.which('chromium') or shutil.which('google-chrome')
QUIET = ('--no-sandbox', '--disable-gpu', '--disable-background-networking', '--no-first-run')

pytestmark = pytest.mark.skipif(BROWSER is None, reason='no chromium; Debian has a package of it')


@pytest.fixture(scope='module')
def complaints() -> list[str]:
    """Messages that the page writes to the browser's console."""
    return []


@pytest.fixture(scope='module')
def page(perfect, complaints) -> Iterator[object]:
    playwright = pytest.importorskip('playwright.sync_api', reason='no playwright to drive it')
    write_results(perfect)
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=BROWSER, args=list(QUIET))
        page = browser.new_page(viewport={'width': 1240, 'height': 900})
        page.on('console', lambda message: complaints.append(message.text))
        page.on('pageerror', lambda error: complaints.append(str(error)))
        page.on('request', lambda request: complaints.extend(loaded(request.url)))
        page.goto(f'file://{perfect / REPORT_FILE}')
        page.wait_for_function('document.querySelectorAll("#animation .scatterlayer").length > 0')
        yield page
        browser.close()


def loaded(address: str) -> list[str]:
    """The address, if it is not of this machine."""
    return [] if address.startswith(('file:', 'data:', 'blob:')) else [address]


def cursor(page) -> float:
    return page.evaluate('cursor')


def time_line(page) -> float:
    return page.evaluate('document.getElementById("time").layout.shapes[0].x0')


def come_to(page, name: str) -> None:
    page.locator(f'#{name}').scroll_into_view_if_needed()
    page.wait_for_function(f'document.querySelector("#{name} .scatterlayer path") !== null')


def test_it_opens_without_a_word_on_the_console_and_draws_the_lap(page, complaints) -> None:
    path = page.locator('#lap .scatterlayer .trace path')
    assert path.count() > 10
    assert page.locator('#lap').bounding_box()['height'] > 400
    assert complaints == []


def test_a_figure_far_below_is_drawn_when_one_comes_to_it(page) -> None:
    page.evaluate('moveTo(0.25)')
    assert page.locator('#time svg').count() == 0
    come_to(page, 'time')
    assert time_line(page) == cursor(page) == 0.25
    assert page.locator('#time .scatterlayer .trace').count() > 5


def test_all_figures_are_drawn_for_print(page) -> None:
    page.evaluate('window.dispatchEvent(new Event("beforeprint"))')
    assert page.locator('#timing-1 .barlayer .point').count() > 0


def test_the_animation_plays_and_pauses(page) -> None:
    before = page.evaluate('document.getElementById("animation").data.at(-3).x[0]')
    page.select_option('#pace', '0.25')
    page.click('#play')
    page.wait_for_function('cursor > 0.05')
    # it times out if nothing is drawn; on a busy machine drawing comes after the clock
    page.wait_for_function(
        'before => document.getElementById("animation").data.at(-3).x[0] !== before', arg=before
    )
    page.click('#play')
    # a busy browser hears of the click later
    page.wait_for_function('!playing')
    stopped = cursor(page)
    time.sleep(0.2)
    assert cursor(page) == stopped
    assert page.text_content('#cursor-time') == f'{stopped:.2f} s'
    come_to(page, 'time')
    assert time_line(page) == stopped


def test_the_animation_draws_the_planned_horizon(page) -> None:
    page.evaluate('moveTo(0.5)')
    ahead = page.evaluate('document.getElementById("animation").data.at(-2).x')
    now = page.evaluate('ANIMATION.runs[0].x[frameAt(ANIMATION.runs[0], 0.5)]')
    assert len(ahead) == 6
    assert ahead[0] - now == pytest.approx(0.0, abs=4.5)
    # 0.35 s at 80 mm/s, less up to 50 ms of age
    assert 20.0 < ahead[-1] - now < 28.5
    assert page.locator('#animation .scatterlayer .trace path.js-line').count() >= 4


def test_a_click_on_the_error_moves_the_cursor(page) -> None:
    page.evaluate('moveTo(0)')
    come_to(page, 'time')
    plot = page.locator('#time .nsewdrag').first
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    page.mouse.move(box['x'] + 0.5 * box['width'], box['y'] + 0.5 * box['height'])
    page.mouse.click(box['x'] + 0.5 * box['width'], box['y'] + 0.5 * box['height'])
    page.wait_for_function('cursor > 0')
    line = time_line(page)
    assert line == cursor(page)
    assert page.evaluate('Number(document.getElementById("cursor").value)') == pytest.approx(
        line, abs=0.011
    )


def test_a_click_on_the_lap_moves_the_cursor(page) -> None:
    come_to(page, 'lap')
    page.evaluate('moveTo(0)')
    point = page.locator('#lap .scatterlayer .trace .point').nth(40)
    point.hover(force=True)
    page.mouse.down()
    page.mouse.up()
    page.wait_for_function('cursor > 0')


def test_moving_the_slider_moves_the_square(page) -> None:
    page.evaluate('moveTo(0)')
    page.locator('#cursor').evaluate('(it) => { it.value = it.max; }')
    page.locator('#cursor').dispatch_event('input')
    end = page.evaluate('[cursor, ANIMATION.duration]')
    assert end[0] == pytest.approx(end[1], abs=0.011)


def test_on_a_phone_nothing_is_wider_than_the_window(page) -> None:
    phone = page.context.browser.new_page(viewport={'width': 390, 'height': 844})
    phone.goto(page.url)
    phone.wait_for_function('document.querySelector("#lap .scatterlayer path") !== null')
    assert phone.evaluate('document.documentElement.scrollWidth') == 390
    bar, plot = (
        phone.locator(f'#lap {part}').first.bounding_box() for part in ('.cbfills', '.nsewdrag')
    )
    assert plot['width'] > 250
    assert bar['y'] > plot['y'] + plot['height']
    phone.close()
