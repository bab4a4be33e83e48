"""Cases, metrics and ratios: tables by id, each over the axes that its id names."""

from collections.abc import Iterator
from typing import Any

from exo.errors import ScenarioError, close_matches
from exo.expansion.axes import Axes, Bound, written

Entry = dict[str, Any]
#: Tables of a case that are joined with what its axes say.
TABLES = ("parameters", "inputs", "profiles")


def by_id(data: Any, *, where: str) -> list[Entry]:
    """`[cases.a]` or `[[cases]]` with `id = "a"`."""
    rows = (
        [{"id": key} | row if isinstance(row, dict) else row for key, row in data.items()]
        if isinstance(data, dict)
        else data
    )
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise ScenarioError(f"{where}: got {data!r}; expected a table for each id")
    return rows


def over_axes(data: Any, *, axes: Axes, where: str) -> Iterator[tuple[Entry, Bound, str]]:
    """Every entry for every combination of the axes in its id, filled in; with its place for messages."""
    for row in by_id(data, where=where):
        place = f"{where}.{row.get('id', '?')}"
        entry = {key: value for key, value in row.items() if key != "over"}
        for bound in axes.each(row.get("id", ""), over=row.get("over", {}), where=place):
            yield dict(axes.fill(entry, bound, where=place)), bound, place


def cases(data: Any, *, axes: Axes, known: Entry, where: str) -> list[Entry]:
    """What the values of its axes say, then what the case says; `"controller.K" = 1.0` is short for its parameters."""
    found = []
    for row, bound, place in over_axes(data, axes=axes, where=where):
        case: Entry = {}
        for part in (*(axes.fill(part, bound, where=place) for part in axes.fragments(bound)), row):
            for key, value in part.items():
                if "." not in key:
                    case[key] = _joined(case.get(key, {}), value) if key in TABLES else value
            dotted = {key: value for key, value in part.items() if "." in key}
            if dotted and isinstance(case.get("parameters", {}), dict):
                case["parameters"] = _joined(case.get("parameters", {}), dotted)
        if "profiles" in case:
            case["profiles"] = profiles(case["profiles"], known["profiles"], where=f"{place}.profiles")
        found.append(case)
    return found


def _joined(base: Any, own: Any) -> Any:
    return base | own if isinstance(base, dict) and isinstance(own, dict) else own


def profiles(data: Any, known: Entry, *, where: str) -> Any:
    """A profile given as a text is the known one of that name."""
    if not isinstance(data, dict):
        return data
    for name, profile in data.items():
        if isinstance(profile, str) and profile not in known:
            raise ScenarioError(f"{where}.{name}: no known profile {profile}{close_matches(profile, known)}")
    return {name: known[profile] if isinstance(profile, str) else profile for name, profile in data.items()}


def metrics(data: Any, *, axes: Axes, known: Entry, where: str) -> list[Entry]:
    """A metric starts from the known one that `like` names, or that has its id. `cases`, `expected` and `paper` may
    name axes: a list in a check has one number for each value."""
    found: list[Entry] = []
    models = dict(known["metrics"])
    for row, _, place in over_axes(data, axes=axes, where=where):
        like = row.pop("like", None)
        if like is not None and str(like) not in models:
            raise ScenarioError(f"{place}.like: no metric {like}{close_matches(str(like), models)}")
        model = models.get(str(like or row.get("id")), {})
        if not model and "id" in row and not {"function", "title", "unit", "source"} & set(row):
            raise ScenarioError(f"{place}: no known metric of this id{close_matches(str(row.get('id')), models)}")
        metric = model | row
        if isinstance(model.get("arguments"), dict) and isinstance(row.get("arguments"), dict):
            metric["arguments"] = model["arguments"] | row["arguments"]
        models[str(metric.get("id"))] = metric
        if isinstance(metric.get("cases"), list):
            metric = metric | {"cases": _names(metric["cases"], axes, f"{place}.cases")}
        for key in ("expected", "paper"):
            if isinstance(metric.get(key), dict):
                metric = metric | {key: dict(_rows(metric[key], axes, f"{place}.{key}"))}
        found.append(metric)
    return found


def _names(names: list[Any], axes: Axes, where: str) -> list[Any]:
    return [written(axes.fill(name, bound, where=where)) for name in names for bound in axes.each(name, where=where)]


def _rows(rows: Entry, axes: Axes, where: str) -> Iterator[tuple[str, Any]]:
    for key, row in rows.items():
        bounds = list(axes.each(key, where=where))
        for name, column in row.items() if isinstance(row, dict) else ():
            if isinstance(column, list) and len(column) != len(bounds):
                raise ScenarioError(
                    f"{where}.{key}.{name}: got {len(column)} numbers; expected {len(bounds)}, one a case"
                )
        for i, bound in enumerate(bounds):
            one = {n: c[i] if isinstance(c, list) else c for n, c in row.items()} if isinstance(row, dict) else row
            yield written(axes.fill(key, bound, where=where)), axes.fill(one, bound, where=where)


def ratios(data: Any, *, axes: Axes, known: Entry, where: str) -> list[Entry]:  # noqa: ARG001, one shape for all three
    """Ratios, one for each combination of the axes in their ids."""
    return [row for row, _, _ in over_axes(data, axes=axes, where=where)]
