"""State, repetition and interleaving through fmpy: every run equals a run alone, bit for bit."""

from collections.abc import Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave

from exo.fmu import Archive
from exo.profile import evaluate
from exo.scenario import load
from exo.simulate import plan, simulate

T = 0.002
#: Ten seconds of the wall scenario's force, from the ramp on: press, hold, pull; with contact and saturation.
FORCE = evaluate(segments=load("wall").profiles["tau_h"], time=11.0 + np.arange(5000) * T)


@contextmanager
def slave(archive: Archive, name: str) -> Any:
    instance = FMU2Slave(
        guid=archive.description.guid,
        unzipDirectory=archive.folder,
        modelIdentifier=archive.description.coSimulation.modelIdentifier,
        instanceName=name,
    )
    instance.instantiate()
    try:
        yield instance
    finally:
        instance.freeInstance()


def initialize(instance: Any) -> None:
    instance.setupExperiment(startTime=0.0)
    instance.enterInitializationMode()
    instance.exitInitializationMode()


class Pair:
    """Controller and plant, stepped with zero delay; remembers all real outputs."""

    def __init__(self, archives: Mapping[str, Archive], controller: Any, plant: Any) -> None:
        self.parts = (controller, plant)
        self.references = [
            {name: v.valueReference for name, v in archives[f"{a}.fmu"].variables.items()}
            for a in ("TestbedController", "Testbed")
        ]
        self.outputs = [
            [
                v.valueReference
                for v in archives[f"{a}.fmu"].variables.values()
                if v.causality == "output" and v.type == "Real"
            ]
            for a in ("TestbedController", "Testbed")
        ]

    def step(self, k: int) -> list[float]:
        (controller, plant), (c, p) = self.parts, self.references
        (q,) = plant.getReal([p["q"]])
        controller.setReal([c["q"], c["tau_h"]], [q, FORCE[k]])
        controller.doStep(k * T, T)
        (tau_a,) = controller.getReal([c["tau_a"]])
        plant.setReal([p["tau_a"], p["tau_h"]], [tau_a, FORCE[k]])
        plant.doStep(k * T, T)
        return controller.getReal(self.outputs[0]) + plant.getReal(self.outputs[1])

    def run(self, ticks: range) -> np.ndarray:
        return np.array([self.step(k) for k in ticks])


@contextmanager
def pair(archives: Mapping[str, Archive], name: str) -> Any:
    with slave(archives["TestbedController.fmu"], f"{name}.c") as c, slave(archives["Testbed.fmu"], f"{name}.p") as p:
        initialize(c)
        initialize(p)
        yield Pair(archives, c, p)


@pytest.fixture(scope="module")
def alone(archives: Mapping[str, Archive]) -> np.ndarray:
    with pair(archives, "alone") as one:
        return one.run(range(5000))


def test_the_run_has_contact_and_saturation(alone: np.ndarray, archives: Mapping[str, Archive]) -> None:
    names = [
        f"{a}.{n}"
        for a, archive in zip(("c", "p"), archives.values(), strict=True)
        for n in archive.names("output")
        if archive.variable(n).type == "Real"
    ]
    assert alone[:, names.index("p.tau_e")].min() < 0.0
    assert abs(alone[:, names.index("c.tau_a")]).max() == 12.5


def test_save_run_on_restore_rerun_is_bit_identical(archives: Mapping[str, Archive], alone: np.ndarray) -> None:
    with pair(archives, "saved") as one:
        one.run(range(1500))
        states = [part.getFMUstate() for part in one.parts]
        first = one.run(range(1500, 3000))
        for part, state in zip(one.parts, states, strict=True):
            part.setFMUstate(state)
        again = one.run(range(1500, 3000))
        for part, state in zip(one.parts, states, strict=True):
            part.freeFMUstate(state)
    assert first.tobytes() == again.tobytes() == alone[1500:3000].tobytes()


def test_a_serialized_state_runs_on_in_another_instance(archives: Mapping[str, Archive], alone: np.ndarray) -> None:
    with pair(archives, "first") as one:
        one.run(range(2000))
        states = [part.getFMUstate() for part in one.parts]
        texts = [part.serializeFMUstate(state) for part, state in zip(one.parts, states, strict=True)]
    with pair(archives, "second") as two:
        for part, text in zip(two.parts, texts, strict=True):
            part.setFMUstate(part.deSerializeFMUstate(text))
        assert two.run(range(2000, 3000)).tobytes() == alone[2000:3000].tobytes()


def test_garbage_states_are_refused_and_the_instance_still_steps(
    archives: Mapping[str, Archive], alone: np.ndarray
) -> None:
    with pair(archives, "garbage") as one:
        one.run(range(1000))
        controller, plant = one.parts
        good = controller.serializeFMUstate(controller.getFMUstate())
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        other = plant.serializeFMUstate(plant.getFMUstate())
        for bad in (bytes(flipped), good[:-1], b"", b"garbage", other):
            with pytest.raises(Exception, match="fmi2DeSerializeFMUstate"):
                controller.deSerializeFMUstate(bad)
        assert one.run(range(1000, 1500)).tobytes() == alone[1000:1500].tobytes()


def test_reset_and_rerun_is_bit_identical(archives: Mapping[str, Archive], alone: np.ndarray) -> None:
    with pair(archives, "reset") as one:
        one.run(range(700))
        for part in one.parts:
            part.reset()
            initialize(part)
        assert one.run(range(2000)).tobytes() == alone[:2000].tobytes()


def test_two_interleaved_pairs_equal_two_alone(archives: Mapping[str, Archive], alone: np.ndarray) -> None:
    with pair(archives, "left") as left, pair(archives, "right") as right:
        ahead = [left.step(k) for k in range(500)]
        behind = []
        for k in range(1500):
            ahead.append(left.step(500 + k))
            behind.append(right.step(k))
    assert np.array(ahead).tobytes() == alone[:2000].tobytes()
    assert np.array(behind).tobytes() == alone[:1500].tobytes()


def test_the_harness_loop_equals_fmpy_s_own_calls_bit_for_bit(
    archives: Mapping[str, Archive], alone: np.ndarray
) -> None:
    # The harness calls the C functions by address; fmpy's checked calls are the second derivation.
    scenario = load("wall")
    segments = tuple(
        segment.model_copy(update={"points": tuple(zip(np.arange(5000) * T, FORCE, strict=True)), "kind": "table"})
        for segment in scenario.profiles["tau_h"][1:2]
    )
    table = segments[0].model_copy(update={"amplitude": 1.0, "t_on": 0.0, "ramp": 0.0})
    job = plan(scenario=scenario, case=scenario.cases[0])
    job = type(job)(**{**vars(job), "parameters": {}, "profiles": {"tau_h": (table,)}, "duration": 10.0})
    run = simulate(plan=job, archives=archives)
    names = [
        n
        for n in archives["TestbedController.fmu"].names("output")
        if archives["TestbedController.fmu"].variable(n).type == "Real"
    ]
    # Sampled outputs of tick k are read after step k by both.
    for column, name in enumerate(names):
        assert run[f"controller.{name}"].tobytes() == np.ascontiguousarray(alone[:, column]).tobytes(), name


def test_one_large_step_runs_the_same_ticks_as_many_small_ones(archives: Mapping[str, Archive]) -> None:
    with (
        slave(archives["TestbedController.fmu"], "large") as large,
        slave(archives["TestbedController.fmu"], "small") as small,
    ):
        variables = archives["TestbedController.fmu"].variables
        reals = [v.valueReference for v in variables.values() if v.causality == "output" and v.type == "Real"]
        for part in (large, small):
            initialize(part)
            part.setReal([variables["tau_h"].valueReference], [2.0])
        large.doStep(0.0, 0.1)
        h = T / 3.0
        for i in range(150):
            small.doStep(i * h, h)
        assert large.getReal(reals) == small.getReal(reals)
        tick = [variables["tick"].valueReference]
        assert large.getInteger(tick) == small.getInteger(tick) == [49]
