"""The keys that a table of a file can have, for the message about one that it cannot have."""

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any, get_args

from pydantic import BaseModel


def keys_at(whole: type[BaseModel], place: Sequence[int | str]) -> list[str]:
    """The keys of the table in which `place` stands; in scenario files also those that are written in files only."""
    model = whole
    for step in place[:-1]:
        field = model.model_fields.get(step) if isinstance(step, str) else None
        if field is not None:
            model = next(_models(field.annotation), model)
    if whole.__name__ != "Scenario":
        return [field.alias or name for name, field in model.model_fields.items()]
    properties = _schema()["properties"] if model is whole else _schema()["$defs"][model.__name__]["properties"]
    return [*properties]


@cache
def _schema() -> dict[str, Any]:
    from exo.expansion.schema import schema  # noqa: PLC0415 (it is made from the scenario's models)

    return schema()


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    """The models in a type: `tuple[Case, ...]` has one."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for one in get_args(annotation):
        yield from _models(one)
