"""A scene: the cases of an experiment that can be drawn, and which two of them to watch."""

import json
import zlib
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from exo.errors import ScenarioError, close_matches
from exo.experiment import Experiment
from exo.plan import Plan
from exo.recording import Recording
from exo.replay import packing, shape
from exo.replay.laws import ABOUT
from exo.replay.motion import Motion
from exo.replay.parts import plant
from exo.replay.sticking import Episode

VERSION = 1
#: Of one case, compressed.
MOST_BYTES = 150_000
#: The laws that the story is about, the proposed ones in order of preference.
STANDARD, PROPOSED = "standard", ("passive_bounded", "passive", "passive_applied")
#: What a story takes at most (s), and the shortest sticking that is one.
WATCHED, WORTH_WATCHING = 20.0, 1.0
#: Before the pressing and after the release (s).
LEAD, TAIL = 1.5, 2.5
SPEEDS = (1.0, 2.0, 4.0, 8.0, 16.0)


def scene(experiment: Experiment, cases: Iterable[str] | None = None) -> dict[str, Any] | None:
    """The scene of these cases, or of all, in the scenario's order; None where no case has a plant that is drawn.
    A case whose signals have blown up is left out.

    ScenarioError for a case that has not run.
    """
    wanted = list(experiment.recordings) if cases is None else list(cases)
    for name in wanted:
        if name not in experiment.recordings:
            raise ScenarioError(f"{experiment.scenario.id}: no case {name}{close_matches(name, experiment.recordings)}")
    labels = {case.id: case.label or case.id for case in experiment.scenario.cases}
    motions = {
        name: motion
        for name in wanted
        if (motion := _motion(experiment.recordings[name], experiment.plans[name])) is not None and motion.is_drawable
    }
    if not motions:
        return None
    drawn = {name: _case(motion, labels[name]) for name, motion in motions.items()}
    pair = _pair(experiment, {name: motion.law for name, motion in motions.items()})
    kinds = {one["geometry"]["kind"] for one in drawn.values()}
    kind = drawn[pair[0]]["geometry"]["kind"]
    return {
        "version": VERSION,
        "title": experiment.scenario.title,
        "kind": kind,
        "range": [0.0, max(float(motions[name].run.time[-1]) for name in motions)],
        "pair": pair,
        "story": _story([motions[name] for name in pair]),
        # One drawing: where a scenario has plants of both kinds, that of the pair.
        "cases": {name: one for name, one in drawn.items() if len(kinds) == 1 or one["geometry"]["kind"] == kind},
    }


def _motion(run: Recording, plan: Plan) -> Motion | None:
    found = plant(run.parameters)
    return None if found is None else Motion(plant=found, run=run, inputs=plan.inputs)


def _case(motion: Motion, label: str) -> dict[str, Any]:
    coarser = 1.0
    while True:
        case = {
            "label": label,
            "law": motion.law,
            "about": ABOUT.get(motion.law, ""),
            "geometry": shape.of(motion.plant, motion.run.parameters),
            "frames": motion.packed(coarser=coarser),
            "sticking": [[one.as_json() for one in side] for side in motion.sticking],
            **_payload(motion),
        }
        if compressed_size(case) <= MOST_BYTES:
            return case
        coarser *= 2.0


def compressed_size(document: Any) -> int:
    """Bytes of a document as JSON, deflated."""
    return len(zlib.compress(json.dumps(document, separators=(",", ":")).encode(), 6))


def _payload(motion: Motion) -> dict[str, Any]:
    """When the pads hold the payload, and where it lies before each grip and after the last one (m, by pad)."""
    if motion.plant.kind == "testbed":
        return {}
    run, name = motion.run, motion.plant.name
    changes = np.flatnonzero(np.diff(motion.attached.astype(np.int8), prepend=0))
    # Before a grip it lies where the pad grips it; after the release where the pad has left it.
    places = []
    for tick in [*changes, len(run.time) - 1]:
        at = [
            [round(float(run[f"{name}.{side}p_pad[{k}]"][tick]), 4) for k in (1, 2, 3)] for side in motion.plant.sides
        ]
        places.append([round(float(np.mean([pad[k] for pad in at])), 4) for k in range(3)])
    return {"attached": packing.switches(motion.attached, run.time), "places": places[:-1] or places}


def _pair(experiment: Experiment, laws: Mapping[str, str]) -> list[str]:
    """The cases to begin with: one of the standard law, best that of the paper's figure, and that of the proposed law
    which differs from it by the least; else the first and the last case."""
    cases = list(laws)
    printed = {name for metric in experiment.scenario.metrics for name in metric.paper}
    standard = [name for name in cases if laws[name] == STANDARD]
    standard.sort(key=lambda name: name not in printed)
    for law in PROPOSED:
        others = [name for name in cases if laws[name] == law]
        if standard and others:
            plans = experiment.plans
            return [standard[0], min(others, key=lambda name: _differences(plans[standard[0]], plans[name]))]
    return list(dict.fromkeys([cases[0], cases[-1]]))


def _differences(a: Plan, b: Plan) -> int:
    mine, other = dict(a.parameters), dict(b.parameters)
    return sum(mine.get(key) != other.get(key) for key in mine | other)


def _story(motions: Iterable[Motion]) -> dict[str, float] | None:
    """The longest sticking of the pair, from before the hand pressed to after its end."""
    found: list[tuple[Episode, float]] = [
        (one, float(motion.run.time[-1])) for motion in motions for side in motion.sticking for one in side
    ]
    if not found:
        return None
    longest, last = max(found, key=lambda one: one[0].end - one[0].begin)
    if longest.end - longest.begin < WORTH_WATCHING:
        return None
    begin, end = max(0.0, longest.pressed - LEAD), min(last, longest.end + TAIL)
    speed = next((s for s in SPEEDS if (end - begin) / s <= WATCHED), SPEEDS[-1])
    return {"from": round(begin, 3), "to": round(end, 3), "speed": speed}
