"""What can go wrong, each as one sentence that names the thing, its value and what was expected."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches


class ExoError(Exception):
    """An error whose text is meant for the user; the command line prints it and exits with code 2."""


class ScenarioError(ExoError):
    """A scenario file or an override that does not say what it must."""


class FmuError(ExoError):
    """A missing archive, an unknown variable, or a call that an FMU refused."""


@contextmanager
def in_case(scenario: str, case: str) -> Iterator[None]:
    """What an FMU refuses in here is told with the scenario and the case that ran."""
    try:
        yield
    except FmuError as error:
        raise FmuError(f"{scenario}: case {case}: {error}") from error


def close_matches(name: str, known: Iterable[str]) -> str:
    """` (close matches: …)` for an unknown name, or all known names when nothing is near and they are few."""
    name, known = str(name), sorted(known)
    near = [one for one in known if one.casefold() == name.casefold()] + get_close_matches(name, known, n=3, cutoff=0.5)
    if near:
        return f" (close matches: {', '.join([*dict.fromkeys(near)][:3])})"
    if 0 < len(known) <= 12:
        return f" (known: {', '.join(known)})"
    return ""
