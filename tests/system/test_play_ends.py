"""How `exo play` ends, and what its page says when nobody answers: of a process of its own."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import sleep
from typing import Any
from urllib.request import urlopen

import pytest

from browser import chromium, until

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no signal to one process")


@contextmanager
def playing(
    fmu_dir: Path, place: Path, *, browser: bool = False, env: dict[str, str] | None = None
) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The command, and the address that it prints."""
    (place / "tmp").mkdir()
    command = [sys.executable, "-m", "exo", "play", "--fmu-dir", str(fmu_dir)]
    command += [] if browser else ["--no-browser"]
    with subprocess.Popen(
        command, cwd=place, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env={**(os.environ if env is None else env), "TMPDIR": str(place / "tmp")},
        # A job in the background has SIGINT ignored, and its children, too.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509  see test_sweep_killed.py
    ) as process:  # fmt: skip
        try:
            assert process.stdout is not None
            found = re.search(r"http://127\.0\.0\.1:\S+", process.stdout.readline())
            process.stdout.readline()
            assert found
            yield process, found[0]
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.kill()


@pytest.mark.parametrize(
    ("sent", "code"),
    [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)],
    ids=["ctrl_c", "a_system_that_shuts_down", "a_terminal_that_is_closed"],
)
def test_it_ends_without_a_word_too_many_and_leaves_nothing_behind(
    sent: str, code: int, fmu_dir: Path, tmp_path: Path
) -> None:
    with playing(fmu_dir, tmp_path) as (process, _):
        sleep(0.3)
        process.send_signal(getattr(signal, sent))
        # The interpreter takes half a second of processor time to end, which may be long while others compute.
        _, said = process.communicate(timeout=120)
    assert process.returncode == code
    assert "Traceback" not in said
    assert list((tmp_path / "tmp").iterdir()) == []


@pytest.mark.skipif(sys.platform == "darwin", reason="macOS always has a browser with a window")
@pytest.mark.parametrize("name", ["w3m", "anything"])
def test_a_browser_that_does_not_return_holds_up_nobody(name: str, fmu_dir: Path, tmp_path: Path) -> None:
    place = tmp_path / "bin"
    place.mkdir()
    (place / name).write_text(f"#!/bin/sh\necho $1 > {tmp_path / 'asked'}\nexec sleep 60\n", encoding="utf-8")
    (place / name).chmod(0o755)
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")
    env = {key: value for key, value in os.environ.items() if key not in hidden} | {
        "TERM": "xterm",
        "PATH": f"{place}:/bin:/usr/bin",
    }
    # The first is found by itself where there is no window, the second is what somebody has set.
    if name == "anything":
        env["BROWSER"] = str(place / name)
    else:
        env["PATH"] = f"{place}:/bin"
    with playing(fmu_dir, tmp_path, browser=True, env=env) as (process, address):
        assert process.stdout is not None
        if name == "w3m":
            assert process.stdout.readline() == "no browser has opened; open the address yourself\n"
        with urlopen(address, timeout=30) as answer:
            assert answer.status == 200
        if name == "anything":
            until_there(tmp_path / "asked")
            assert (tmp_path / "asked").read_text(encoding="utf-8").strip() == address
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=120) == 143
    assert (tmp_path / "asked").exists() == (name == "anything")


def until_there(path: Path) -> None:
    """Waits for a file that is written at once."""
    for _ in range(300):
        if path.is_file() and path.stat().st_size:
            return
        sleep(0.1)
    pytest.fail(f"{path.name} is not there")


def test_the_page_says_when_nobody_answers_and_that_nothing_was_saved(fmu_dir: Path, tmp_path: Path) -> None:
    with playing(fmu_dir, tmp_path) as (process, address), chromium() as browser:
        page = browser.new_page()
        page.goto(address)
        until(page, lambda: page.inner_text("#status") == "running")
        page.keyboard.down("ArrowRight")
        until(page, lambda: page.input_value("#forces input") == "2.5")
        process.send_signal(signal.SIGSTOP)
        says(page, "exo play has not answered for some seconds")
        # Who lets go meanwhile has let go.
        page.keyboard.up("ArrowRight")
        assert page.inner_text("#status") == "no answer"
        page.click("#save button")
        assert page.inner_text("#saved") == "Not saved: exo play does not answer."
        process.send_signal(signal.SIGCONT)
        until(page, lambda: not page.is_visible("#lost"))
        # After a sleep the run goes on from where it stood.
        until(page, lambda: page.inner_text("#status") == "running")
        until(page, lambda: page.input_value("#forces input") == "0")
        process.kill()
        says(page, "The connection to exo play is gone. If the command has ended, start it again")
        assert page.inner_text("#status") == "no answer"


def says(page: Any, words: str) -> None:
    """Waits until the page says it, in sight."""
    until(page, lambda: page.is_visible("#lost") and words in page.inner_text("#lost"))
