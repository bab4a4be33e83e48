"""Rules and findings: a rule is declared once, beside the code that checks it, and makes its findings."""

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How bad a finding is."""

    #: The standard forbids it, or no importer can use the FMU.
    ERROR = "error"
    #: The standard allows it, but a common importer or operating system stumbles over it.
    WARNING = "warning"


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong: which rule, where, what is there and what was expected."""

    rule: str
    severity: Severity
    #: File in the archive, with line and element where they are known.
    where: str
    value: str
    expected: str

    def __str__(self) -> str:
        return f"{self.severity}: {self.where}: {self.value}; expected {self.expected} [{self.rule}]"


@dataclass(frozen=True)
class Rule:
    """What must hold."""

    id: str
    severity: Severity
    #: One sentence, true of a good FMU.
    text: str
    #: The only version of FMI that it judges; empty for both.
    only: str = ""

    def at(self, where: str, value: object, expected: str) -> Finding:
        """The finding that this rule is broken."""
        return Finding(self.id, self.severity, printable(where), printable(str(value)), printable(expected))


#: All rules by id, in the order of their modules.
RULES: dict[str, Rule] = {}


def error(rule_id: str, text: str, *, only: str = "") -> Rule:
    """Declares a rule whose violation is an error; `only`: the one version of FMI that it judges."""
    return _declare(Rule(rule_id, Severity.ERROR, text, only))


def warning(rule_id: str, text: str, *, only: str = "") -> Rule:
    """Declares a rule whose violation is a warning."""
    return _declare(Rule(rule_id, Severity.WARNING, text, only))


def printable(text: str, limit: int = 300) -> str:
    """`text` without control characters (an archive may carry terminal codes in its names), shortened."""
    safe = text[: limit + 1]
    if not safe.isprintable():
        safe = "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in safe)
    return safe if len(safe) <= limit else f"{safe[:limit]}…"


def _declare(rule: Rule) -> Rule:
    if rule.id in RULES:
        raise ValueError(f"two rules are called {rule.id}")
    RULES[rule.id] = rule
    return rule
