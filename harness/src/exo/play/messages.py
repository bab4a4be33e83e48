"""What a page says to the run, as one JSON object with one key, and what it is answered.

| message | what it does |
|---|---|
| `{"set": {"name": "K", "to": 40}}` | a knob |
| `{"other": {"name": "law", "to": "standard"}}` | a knob for a new run, in which the hand pushes as in this one |
| `{"switch": {"name": "vacuum", "to": true}}` | a switch |
| `{"hand": {"target": [0.2], "push": [0], "stiffness": 200}}` | the hand, or what of it changes; target null lets go |
| `{"pause": true}` | holds the clock |
| `{"again": {}}` | a new run |
| `{"save": "name"}` | writes the run as a scenario |
"""

import json
import shlex
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from exo.errors import ExoError, close_matches
from exo.naming import file_name
from exo.play import saved
from exo.play.live import Live

#: What a page may send at once (bytes).
LONGEST = 4096
HAND = ("target", "push", "stiffness")

Answer = dict[str, Any] | None


def take(live: Live, text: str, *, out: Path, run_options: str = "") -> Answer:
    """Does what a message says. `{"error": sentence}`, if it cannot; `{"saved": …, "command": …}` for a file.

    `run_options` are what `exo run` needs to repeat a run, such as the folder of the FMUs.
    """
    try:
        verb, given = _parsed(text)
        if verb == "save":
            return _save(live, given, out, run_options)
        _verbs(live)[verb](given)
    except (ExoError, ValueError) as error:
        return {"error": " ".join(str(error).split())}
    except Exception as error:  # a page whose socket breaks off without a word helps nobody
        said = " ".join(str(error).split())
        return {"error": f"an error of exo itself: {type(error).__name__}: {said}"}
    return None


def moved(text: str) -> frozenset[str]:
    """What of the hand a message moves: some of target and push."""
    with suppress(ExoError):
        verb, given = _parsed(text)
        if verb == "hand" and isinstance(given, dict):
            return frozenset(given) & {"target", "push"}
    return frozenset()


def _parsed(text: str) -> tuple[str, Any]:
    if len(text) > LONGEST:
        raise ExoError(f"a message of {len(text)} letters; expected at most {LONGEST}")
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        raise ExoError(f"{text[:40]!r} is no JSON; expected an object such as {{'pause': true}}") from None
    if not isinstance(found, dict) or len(found) != 1:
        raise ExoError(f"{text[:40]!r}: expected a JSON object with one key")
    verb, given = next(iter(found.items()))
    known = ("set", "other", "switch", "hand", "pause", "again", "save")
    if verb not in known:
        raise ExoError(f"no message {verb[:40]!r}{close_matches(verb[:40], known)}")
    return verb, given


def _verbs(live: Live) -> Mapping[str, Callable[[Any], None]]:
    return {
        "set": lambda given: live.set(*_named("set", given)),
        "other": lambda given: live.other(*_named("other", given)),
        "switch": lambda given: live.switch(*_named("switch", given)),
        "hand": lambda given: _hand(live, given),
        "pause": live.pause,
        "again": lambda _given: live.again(),
    }


def _named(verb: str, given: object) -> tuple[str, object]:
    if not isinstance(given, dict) or set(given) != {"name", "to"} or not isinstance(given["name"], str):
        raise ExoError(f"{verb}: {given!r:.40}: expected an object with name and to")
    return given["name"], given["to"]


def _hand(live: Live, given: object) -> None:
    if not isinstance(given, dict) or not set(given) <= set(HAND):
        raise ExoError(f"hand: {given!r:.40}: expected an object with some of {', '.join(HAND)}")
    live.hand(**given)


def _save(live: Live, given: object, out: Path, run_options: str) -> Answer:
    if not isinstance(given, str):
        raise ExoError(f"save: {given!r:.40}: expected a name")
    try:
        name = file_name(given.strip())
    except ValueError as error:
        # To the page it is a name; to a scenario, an id.
        raise ExoError(f"name{str(error).removeprefix('id')}") from error
    try:
        path = saved.write(live.tables(), out, name)
    except OSError as error:
        raise ExoError(f"{out}: cannot be written: {error.strerror or error}; expected a folder") from error
    return {"saved": str(path), "command": f"exo run {shlex.quote(str(path))}{run_options}"}
