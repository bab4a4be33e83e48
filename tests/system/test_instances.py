"""State, repetition and interleaving through fmpy: every run equals a run alone, bit for bit."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave

from exo.fmu import Archive
from exo.master import Plan, plan, simulate
from exo.profile import evaluate
from exo.scenario import Segment, load

TICKS = 5000


def wall() -> Plan:
    """Ten seconds of the wall scenario's force, from the ramp on: press, hold, pull; with contact and saturation."""
    scenario = load("wall")
    T = scenario.step
    time = np.arange(TICKS) * T
    force = evaluate(segments=scenario.profiles["tau_h"], time=11.0 + time)
    table = Segment(kind="table", points=tuple(zip(time.tolist(), force.tolist(), strict=True)))
    job = plan(scenario=scenario, case=scenario.cases[0])
    return Plan(**{**vars(job), "parameters": {}, "profiles": {"tau_h": (table,)}, "duration": TICKS * T})


def arm() -> Plan:
    """Five seconds of gripping a payload, lifting and dropping it, by a hand with reflex delay; noise on the sensor."""
    scenario = load("arm_payload")
    job = plan(scenario=scenario, case=scenario.cases[1])
    segments = [
        {"axis": 3, "kind": 2, "t_on": 0.2, "t_off": 1.5, "ramp": 0.1, "amplitude": -10.0},
        {"axis": 3, "kind": 2, "t_on": 2.0, "ramp": 0.1, "amplitude": 8.0},
        {"axis": 2, "kind": 1, "t_on": 0.0, "ramp": 0.1, "amplitude": 5.0},
    ]
    parameters = {
        "plant.table.z": -0.3771,
        "plant.payload.m": 17.5,
        "plant.ft.noise": 0.2,
        "plant.encoder.kind": 2,
        "controller.law": 2,
        "operator.k_h": 20.0,
        "operator.delay": 0.05,
        **{f"operator.segment[{i}].{key}": x for i, s in enumerate(segments, start=1) for key, x in s.items()},
    }
    vacuum = (Segment(kind="constant", t_on=0.5, t_off=4.0),)
    inputs = job.inputs | {f"controller.f_h[{i}]": f"plant.f_h_measured[{i}]" for i in (1, 2, 3)}
    changes = {"parameters": parameters, "profiles": {"vacuum": vacuum}, "inputs": inputs, "duration": TICKS * job.step}
    return Plan(**{**vars(job), **changes})


class Chain:
    """A plan with zero delay by fmpy's checked calls; remembers all real outputs."""

    def __init__(self, job: Plan, archives: Mapping[str, Archive], slaves: Mapping[str, Any]) -> None:
        self.job = job
        self.parts = slaves
        self.variables = {name: archives[file].variables for name, file in job.components.items()}
        time = np.arange(TICKS) * job.step
        self.profiles = {name: evaluate(segments=segments, time=time) for name, segments in job.profiles.items()}
        self.outputs = {
            name: [v for v in variables.values() if v.causality == "output" and v.type == "Real"]
            for name, variables in self.variables.items()
        }

    def columns(self) -> list[str]:
        """Names of what a step returns."""
        return [f"{name}.{v.name}" for name, outputs in self.outputs.items() for v in outputs]

    def initialize(self) -> None:
        for name, part in self.parts.items():
            for key, value in self.job.parameters.items():
                component, variable = key.split(".", 1)
                if component == name:
                    self._set(name, variable, value)
            part.setupExperiment(startTime=0.0)
            part.enterInitializationMode()
        for _ in self.parts:
            for name in self.parts:
                self._set_inputs(name, 0)
        for part in self.parts.values():
            part.exitInitializationMode()

    def _set(self, name: str, variable: str, value: Any) -> None:
        v = self.variables[name][variable]
        getattr(self.parts[name], f"set{v.type}")([v.valueReference], [value])

    def _set_inputs(self, name: str, k: int) -> None:
        for key, origin in self.job.inputs.items():
            (to, variable), (component, output) = key.split(".", 1), origin.split(".", 1)
            if to != name:
                continue
            if component == "profile":
                value = self.profiles[output][k]
            else:
                (value,) = self.parts[component].getReal([self.variables[component][output].valueReference])
            self._set(name, variable, bool(value) if self.variables[name][variable].type == "Boolean" else value)

    def step(self, k: int) -> list[float]:
        for name, part in self.parts.items():
            self._set_inputs(name, k)
            part.doStep(k * self.job.step, self.job.step)
        return [
            value
            for name, part in self.parts.items()
            for value in part.getReal([v.valueReference for v in self.outputs[name]])
        ]

    def run(self, ticks: range) -> np.ndarray:
        return np.array([self.step(k) for k in ticks])


@contextmanager
def slave(archive: Archive, name: str) -> Iterator[Any]:
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


@contextmanager
def chain(job: Plan, archives: Mapping[str, Archive], name: str) -> Iterator[Chain]:
    with ExitStack() as stack:
        slaves = {
            part: stack.enter_context(slave(archives[file], f"{name}.{part}")) for part, file in job.components.items()
        }
        one = Chain(job, archives, slaves)
        one.initialize()
        yield one


@pytest.fixture(scope="module", params=[wall, arm], ids=["testbed", "arm"])
def job(request: pytest.FixtureRequest) -> Plan:
    return request.param()


@pytest.fixture(scope="module")
def alone(job: Plan, archives: Mapping[str, Archive]) -> np.ndarray:
    with chain(job, archives, "alone") as one:
        return one.run(range(TICKS))


def test_the_testbed_s_run_has_contact_and_saturation(archives: Mapping[str, Archive]) -> None:
    run = simulate(plan=wall(), archives=archives)
    assert run["plant.tau_e"].min() < 0.0
    assert abs(run["controller.tau_a"]).max() == 12.5


def test_the_arm_s_run_grips_lifts_and_drops_and_saturates(archives: Mapping[str, Archive]) -> None:
    run = simulate(plan=arm(), archives=archives)
    held = run["plant.attached"]
    assert [held[k] for k in (400, 3000, 4500)] == [False, True, False]
    assert run["plant.p[3]"][3900] > run["plant.p[3]"][1500] + 0.02
    assert run["plant.f_e[3]"].max() > 100.0
    assert run["controller.saturated"].any()
    assert np.std(run["controller.f_h[1]"] - run["operator.f_h[1]"]) > 0.1


def test_save_run_on_restore_rerun_is_bit_identical(
    job: Plan, archives: Mapping[str, Archive], alone: np.ndarray
) -> None:
    with chain(job, archives, "saved") as one:
        one.run(range(1500))
        states = {name: part.getFMUstate() for name, part in one.parts.items()}
        first = one.run(range(1500, 3000))
        for name, part in one.parts.items():
            part.setFMUstate(states[name])
        again = one.run(range(1500, 3000))
        for name, part in one.parts.items():
            part.freeFMUstate(states[name])
    assert first.tobytes() == again.tobytes() == alone[1500:3000].tobytes()


def test_a_serialized_state_runs_on_in_another_instance(
    job: Plan, archives: Mapping[str, Archive], alone: np.ndarray
) -> None:
    with chain(job, archives, "first") as one:
        one.run(range(2000))
        texts = {name: part.serializeFMUstate(part.getFMUstate()) for name, part in one.parts.items()}
    with chain(job, archives, "second") as two:
        for name, part in two.parts.items():
            part.setFMUstate(part.deSerializeFMUstate(texts[name]))
        assert two.run(range(2000, 3000)).tobytes() == alone[2000:3000].tobytes()


def test_garbage_states_are_refused_and_the_instance_still_steps(
    job: Plan, archives: Mapping[str, Archive], alone: np.ndarray
) -> None:
    with chain(job, archives, "garbage") as one:
        one.run(range(1000))
        states = {name: part.serializeFMUstate(part.getFMUstate()) for name, part in one.parts.items()}
        for name, part in one.parts.items():
            good = states[name]
            flipped = bytearray(good)
            flipped[len(good) // 2] ^= 1
            others = [state for other, state in states.items() if other != name]
            for bad in (bytes(flipped), good[:-1], b"", b"garbage", *others):
                with pytest.raises(Exception, match="fmi2DeSerializeFMUstate"):
                    part.deSerializeFMUstate(bad)
        assert one.run(range(1000, 1500)).tobytes() == alone[1000:1500].tobytes()


def test_reset_and_rerun_is_bit_identical(job: Plan, archives: Mapping[str, Archive], alone: np.ndarray) -> None:
    with chain(job, archives, "reset") as one:
        one.run(range(700))
        for part in one.parts.values():
            part.reset()
        one.initialize()
        assert one.run(range(2000)).tobytes() == alone[:2000].tobytes()


def test_two_interleaved_chains_equal_two_alone(job: Plan, archives: Mapping[str, Archive], alone: np.ndarray) -> None:
    with chain(job, archives, "left") as left, chain(job, archives, "right") as right:
        ahead = [left.step(k) for k in range(500)]
        behind = []
        for k in range(1500):
            ahead.append(left.step(500 + k))
            behind.append(right.step(k))
    assert np.array(ahead).tobytes() == alone[:2000].tobytes()
    assert np.array(behind).tobytes() == alone[:1500].tobytes()


def test_the_harness_loop_equals_fmpy_s_own_calls_bit_for_bit(
    job: Plan, archives: Mapping[str, Archive], alone: np.ndarray
) -> None:
    # The harness calls the C functions by address; fmpy's checked calls are the second derivation.
    run = simulate(plan=job, archives=archives)
    with chain(job, archives, "names") as one:
        columns = one.columns()
    for j, key in enumerate(columns):
        component, name = key.split(".", 1)
        # After step k both hold the sampled outputs of tick k and the continuous ones at the beginning of tick k + 1.
        sampled = archives[job.components[component]].variable(name).variability == "discrete"
        mine, theirs = (run[key], alone[:, j]) if sampled else (run[key][1:], alone[:-1, j])
        assert mine.tobytes() == np.ascontiguousarray(theirs).tobytes(), key


@pytest.mark.parametrize(("file", "force"), [("TestbedController.fmu", "tau_h"), ("ArmController.fmu", "f_h[3]")])
def test_steps_that_divide_the_period_run_its_ticks_and_a_longer_one_is_one_sample(
    file: str, force: str, archives: Mapping[str, Archive]
) -> None:
    archive = archives[file]
    T = float(archive.description.defaultExperiment.stepSize)
    with slave(archive, "whole") as whole, slave(archive, "small") as small, slave(archive, "large") as large:
        reals = [v.valueReference for v in archive.variables.values() if v.causality == "output" and v.type == "Real"]
        for part in (whole, small, large):
            part.setupExperiment(startTime=0.0)
            part.enterInitializationMode()
            part.exitInitializationMode()
            part.setReal([archive.variable(force).valueReference], [2.0])
        first = whole.getReal(reals)
        for k in range(50):
            whole.doStep(k * T, T)
        for i in range(150):
            small.doStep(i * T / 3.0, T / 3.0)
        large.doStep(0.0, 50 * T)
        assert first != whole.getReal(reals) == small.getReal(reals)
        tick, period = ([archive.variable(name).valueReference] for name in ("tick", "sample_period"))
        assert [part.getInteger(tick) for part in (whole, small, large)] == [[49], [49], [0]]
        assert [part.getReal(period)[0] for part in (whole, small, large)] == pytest.approx([T, T, 50 * T], rel=1e-12)
