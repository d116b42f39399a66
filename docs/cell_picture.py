"""Films the live page beside a cell in lockstep for the README, with Chromium.

python docs/cell_picture.py docs/cell.gif
"""

import io
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import sync_playwright

WIDTH, HEIGHT, SCALE = 1100, 820, 0.6  # [px] of the window, pixels of the picture for each
FRAMES, PAUSE = 30, 400  # at most; time between two [ms] in the film
COLOURS = 64
LIVE = ('live', '--ros-args', '-p', 'port:=0', '-p', 'page_port:=0')
CELL = ('cell', '--mode', 'lockstep', '--track', 'eight')


def frames(page: Any, cell: 'subprocess.Popen[bytes]') -> Iterator[Image.Image]:
    """Pictures of a page until a cell has ended."""
    while cell.poll() is None:
        yield Image.open(io.BytesIO(page.screenshot())).convert('RGB')
        time.sleep(0.05)


def film(address: str, runs: str) -> list[Image.Image]:
    """Runs a cell, and films the live page at an address."""
    browser_path = shutil.which('chromium') or shutil.which('google-chrome')
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=browser_path, args=['--no-sandbox'])
        page = browser.new_page(
            viewport={'width': WIDTH, 'height': HEIGHT}, device_scale_factor=SCALE
        )
        page.goto(address)
        with subprocess.Popen(['ros2', 'run', 'push_bringup', *CELL, '-o', runs]) as cell:
            page.wait_for_function('document.body.innerText.includes("tracking")', timeout=0)
            seen = list(frames(page, cell))
        browser.close()
    return seen


def main(picture: Path) -> None:
    """Writes an animated GIF of a running cell."""
    with (
        tempfile.TemporaryDirectory() as runs,
        subprocess.Popen(
            ['ros2', 'run', 'push_bag', *LIVE], stderr=subprocess.PIPE, text=True
        ) as live,
    ):
        assert live.stderr is not None
        address = 'http://' + live.stderr.readline().split('http://')[1].split()[0]
        seen = film(address, runs)
        live.terminate()
    chosen = seen[:: -(-len(seen) // FRAMES)]
    first, *others = [each.quantize(COLOURS) for each in chosen]
    first.save(picture, save_all=True, append_images=others, duration=PAUSE, loop=0, optimize=True)


if __name__ == '__main__':
    main(Path(sys.argv[1]))
