"""Photographs the top of a report for the README, with Chromium.

python docs/report_picture.py RUN docs/report.png
"""

import shutil
import sys
from pathlib import Path

from playwright.sync_api import sync_playwright

WIDTH, HEIGHT, SCALE = 1240, 1800, 0.68  # [px] of the window, pixels of the picture for each


def photograph(run_folder: Path, picture: Path) -> None:
    """Writes the first figures of a run's report as PNG."""
    browser_path = shutil.which('chromium') or shutil.which('google-chrome')
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=browser_path, args=['--no-sandbox'])
        page = browser.new_page(
            viewport={'width': WIDTH, 'height': HEIGHT}, device_scale_factor=SCALE
        )
        page.goto((run_folder / 'report.html').resolve().as_uri())
        page.wait_for_function('document.querySelector("#lap .scatterlayer path") !== null')
        # the animation shows nothing at rest, the figure below it does
        page.evaluate('document.getElementById("animation").closest("section").remove()')
        page.wait_for_function('document.querySelector("#time .scatterlayer path") !== null')
        page.screenshot(path=picture)
        browser.close()


if __name__ == '__main__':
    photograph(Path(sys.argv[1]), Path(sys.argv[2]))
