"""Studies that the tests of sweeps run, and how they look at what comes out."""

import json
from typing import Any

import pyarrow as pa

from exo import sweep
from exo.runs import FAILURE
from exo.sweep import store, study

WALL = """
id = "small"
title = "Time to let go"
scenario = "wall"
cases = ["passive_bounded_5_0.5"]
metrics = ["release_delay", "tank"]
[axes."controller.K"]
values = [10.0, 20.0, 30.0]
[axes."controller.M_n"]
low = 2.0
high = 8.0
scale = "log"
count = 2
[[figures]]
id = "map"
title = "Time to let go"
kind = "map"
x = "controller.K"
y = "controller.M_n"
color = "release_delay"
limit = 0.4
"""
#: Long enough to be killed in the middle.
LONG = WALL.replace("values = [10.0, 20.0, 30.0]", "low = 5.0\nhigh = 50.0\ncount = 60").replace('"small"', '"long"')
LONG_ROWS = 120


def numbers(table: pa.Table) -> dict[str, list[Any]]:
    """All columns but the time that rows took."""
    return {name: table[name].to_pylist() for name in table.column_names if name != store.SECONDS}


def sampled(method: str, seed: int = 1) -> study.Study:
    data = {
        "id": "s",
        "title": "s",
        "scenario": "wall",
        "sampling": {"method": method, "samples": 256, "seed": seed},
        "axes": {
            "a": {"low": 1.0, "high": 100.0, "scale": "log"},
            "b": {"mean": 5.0, "deviation": 2.0},
            "c": {"values": [1, 2, 4]},
        },
    }
    return study.Study.model_validate_json(json.dumps(data))


#: The rows with K = 20 end the process that runs them.
DEADLY = """
import os, exo.runs as runs
plain = runs.Batch.run
def run(self, row):
    if row.get('controller.K') == 20.0:
        os._exit(7)
    return plain(self, row)
runs.Batch.run = run
"""


def assert_one_row_is_deadly(done: sweep.Swept) -> None:
    errors = dict(zip(done.table["controller.K"].to_pylist(), done.table[FAILURE].to_pylist(), strict=True))
    assert done.failed == 2
    assert errors[10.0] is None
    assert errors[30.0] is None
    assert "its process was ended twice" in str(errors[20.0])
