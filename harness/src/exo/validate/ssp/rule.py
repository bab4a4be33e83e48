"""The rules of SSP archives: a registry beside that of FMUs, since an FMU cannot break them."""

from exo.validate.rule import Rule, Severity

#: All rules of this package by id, in the order of its modules.
RULES: dict[str, Rule] = {}


def error(rule_id: str, text: str) -> Rule:
    """Declares a rule whose violation is an error."""
    return _declare(Rule(f"ssp-{rule_id}", Severity.ERROR, text))


def warning(rule_id: str, text: str) -> Rule:
    """Declares a rule whose violation is a warning."""
    return _declare(Rule(f"ssp-{rule_id}", Severity.WARNING, text))


def _declare(rule: Rule) -> Rule:
    if rule.id in RULES:
        raise ValueError(f"two rules are called {rule.id}")
    RULES[rule.id] = rule
    return rule
