"""Runs one experiment with fmpy and tells what came out; a program of its own, as `validate/probe.py` is.

fmpy's own way to set inputs is not taken: it cannot set vectors of FMI 3.0 that are discrete, nor vectors beside
scalars.
"""

import json
import sys
from bisect import bisect_right
from math import isclose
from pathlib import Path
from typing import Any

import fmpy

#: Two instants that are the same: times are sums in some importers, products in others.
SAME = 1e-9


class Stimulus:
    """One variable's values over time."""

    def __init__(self, task: dict[str, Any], time: list[float], is_fmi3: bool) -> None:
        self.time, self.values = time, task["values"]
        self.reference, self.held = task["reference"], task["held"]
        self.whole = task["kind"] not in ("Real", "Float32", "Float64")
        integer = "Int64" if is_fmi3 else "Integer"
        self.setter = f"set{integer if task['kind'] == 'Enumeration' else task['kind']}"

    def at(self, t: float) -> list[float] | list[int]:
        """The values at an instant: on a straight line between two samples, or held; before the first one its values.

        Of several samples at one instant the last one counts.
        """
        right = bisect_right(self.time, t + SAME * max(1.0, abs(t)))
        left = self.values[max(right - 1, 0)]
        if self.whole:
            return [round(value) for value in left]
        if self.held or right in (0, len(self.time)) or isclose(t, self.time[right - 1], rel_tol=SAME, abs_tol=SAME):
            return list(left)
        share = (t - self.time[right - 1]) / (self.time[right] - self.time[right - 1])
        return [a + share * (b - a) for a, b in zip(left, self.values[right], strict=True)]

    def set(self, instance: Any, t: float) -> None:
        """Sets the variable."""
        getattr(instance, self.setter)([self.reference], self.at(t))


def play(task: dict[str, Any]) -> dict[str, Any]:
    """Times and columns, each a list of rows."""
    description = fmpy.read_model_description(task["folder"], validate=False)
    is_fmi3 = description.fmiVersion.startswith("3")
    stimuli = [Stimulus(one, task["time"], is_fmi3) for one in task["stimuli"]]
    begin = task["start"]

    def next_inputs(t: float, recorder: Any) -> bool:
        for one in stimuli:
            one.set(recorder.fmu, t)
        return True

    start_values = dict(task["values"])
    for one, stated in zip(stimuli, task["stimuli"], strict=True):
        values = one.at(begin)
        start_values[stated["name"]] = values if stated["vector"] else values[0]
    result = fmpy.simulate_fmu(
        task["folder"],
        validate=False,
        model_description=description,
        fmi_type="CoSimulation",
        start_time=begin,
        stop_time=task["stop"],
        output_interval=task["step"],
        relative_tolerance=task["tolerance"],
        start_values=start_values,
        output=task["outputs"],
        step_finished=next_inputs,
        remote_platform=None,
    )
    missing = [name for name in task["outputs"] if name not in result.dtype.names]
    if missing:
        raise ValueError(f"fmpy does not record {', '.join(missing)}")
    rows = {name: result[name].reshape(len(result), -1).astype(float).tolist() for name in task["outputs"]}
    return {"time": result["time"].tolist(), "columns": rows}


def main() -> None:
    """Plays the task from stdin; its answer is a line of JSON in the file of the first argument."""
    task = json.load(sys.stdin)
    with Path(sys.argv[1]).open("a", encoding="utf-8") as file:

        def tell(fact: dict[str, Any]) -> None:
            file.write(json.dumps(fact) + "\n")
            file.flush()

        tell({"call": "the experiment"})
        try:
            tell({"played": play(task)})
        except Exception as error:  # of fmpy, which raises plain exceptions, or of the system's loader
            tell({"failed": " ".join(str(error).split()).replace(f"{task['folder']}/", "") or type(error).__name__})
        tell({"done": True})


if __name__ == "__main__":
    main()
