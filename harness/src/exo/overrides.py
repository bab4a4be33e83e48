"""What the command line changes: `--set` as values of the FMUs' types, and which expectations that makes void.

An expectation holds for the parameters of its scenario. Where another value is set, its metric is information, unless
it says what it rests on (`rests_on`) and that is not what has changed.
"""

from collections.abc import Mapping
from fnmatch import fnmatchcase

from exo.errors import FmuError, ScenarioError, close_matches
from exo.fmu import Archive
from exo.master import Plan
from exo.naming import elements
from exo.scenario import Scenario, Value


def parse(scenario: Scenario, archives: Mapping[str, Archive], texts: Mapping[str, str]) -> dict[str, Value]:
    """Texts by `component.name`, ranges of arrays among them, as one value an element."""
    parsed: dict[str, Value] = {}
    for key, text in texts.items():
        component, _, name = key.partition(".")
        if component not in scenario.components or not name:
            known = close_matches(component, scenario.components)
            raise ScenarioError(f"--set {key}: expected <component>.<parameter>, got component {component!r}{known}")
        archive = archives[scenario.components[component].archive]
        try:
            names = elements(name)
        except ValueError as error:
            raise ScenarioError(f"--set {key}: {error}") from error
        parsed.update({f"{component}.{element}": archive.parse(element, text) for element in names})
    return parsed


def changed(*, plain: Plan, overrides: Mapping[str, Value], archives: Mapping[str, Archive]) -> tuple[str, ...]:
    """Of the overrides those that give a case another value than it has by itself; `plain` is its plan without them."""
    found = []
    for key, value in overrides.items():
        component, name = key.split(".", 1)
        archive = archives[plain.components[component]]
        own = plain.parameters.get(key, archive.variable(name).start)
        try:
            # A start value is the description's text.
            own = archive.parse(name, own) if isinstance(own, str) else own
            if own is not None and archive.start_value(name, value) == archive.start_value(name, own):
                continue
        except FmuError:
            pass  # what is wrong with the value is told where it is set
        found.append(key)
    return tuple(found)


def void(rests_on: tuple[str, ...] | None, names: tuple[str, ...]) -> tuple[str, ...]:
    """Of the changed names those on which an expectation rests: all of them where it does not say."""
    if rests_on is None:
        return names
    plain = {name: name.split("[", 1)[0] for name in names}
    return tuple(name for name in names if any(fnmatchcase(plain[name], pattern) for pattern in rests_on))
