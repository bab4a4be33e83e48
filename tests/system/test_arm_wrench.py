"""The six-axis input of ArmController.fmu: frames and lever arm against Pinocchio, and what a tare leaves.

The sensor's readings come from Pinocchio's spatial forces on its own model of the arm; the FMU gets numbers only.
"""

from collections.abc import Iterator
from ctypes import c_double, c_int, c_void_p
from pathlib import Path

import numpy as np
import pinocchio
import pytest
from numpy.typing import NDArray

from exo import tool
from exo.fmu import Archive, Instance
from oracles.engines import Arm, Pinocchio

T = 1e-3
GRAVITY = np.array([0.0, 0.0, -9.81])
Vector = NDArray[np.float64]


def vector(name: str, value: Vector) -> dict[str, float]:
    return {f"{name}[{i + 1}]": float(x) for i, x in enumerate(value)}


@pytest.fixture(scope="module")
def archive(fmu_dir: Path) -> Iterator[Archive]:
    with Archive(fmu_dir / "ArmController.fmu") as archive:
        yield archive


class Sensor:
    """A sensor on link 3 with a tool of `mass` (kg) and centre of gravity `cog` (m), as Pinocchio sees it.

    `mount`: roll, pitch, yaw (rad); `handle`: the handle from the sensor's origin (m, sensor frame).
    """

    def __init__(self, *, random: np.random.Generator) -> None:
        self.mount = random.uniform(-3.0, 3.0, 3)
        self.handle = random.uniform(-0.15, 0.15, 3)
        self.mass = float(random.uniform(0.2, 1.5))
        self.cog = random.uniform(-0.05, 0.08, 3)
        self.bias_force = random.uniform(-8.0, 8.0, 3)
        self.bias_torque = random.uniform(-0.8, 0.8, 3)
        self.model = Pinocchio(Arm()).model
        self.data = self.model.createData()

    def place(self, q: Vector) -> pinocchio.SE3:
        """The sensor's frame in the base frame; where it lies does not matter to what it reads."""
        pinocchio.forwardKinematics(self.model, self.data, q)
        link_3 = self.data.oMi[3].rotation
        return pinocchio.SE3(link_3 @ pinocchio.rpy.rpyToMatrix(*self.mount), np.array([0.3, -0.2, 0.5]))

    def reading(self, q: Vector, *, force: Vector, moment: Vector) -> tuple[Vector, Vector]:
        """Force and moment of the hand about the handle, base frame axes, plus weight, as the sensor reads them."""
        sensor = self.place(q)

        def at(point: Vector, f: Vector, n: Vector) -> pinocchio.Force:
            """A wrench about a point of the sensor's frame, in base axes, transported to the sensor's origin."""
            there = pinocchio.SE3(sensor.rotation.T, point)  # base axes at the point, seen from the sensor
            return there.act(pinocchio.Force(f, n))

        total = at(self.handle, force, moment) + at(self.cog, self.mass * GRAVITY, np.zeros(3))
        return total.linear + self.bias_force, total.angular + self.bias_torque

    def parameters(self) -> dict[str, float]:
        return {
            "ft.source": 2,
            "ft.mass": self.mass,
            **vector("ft.cog", self.cog),
            **vector("ft.mount", self.mount),
            **vector("ft.handle", self.handle),
        }


def poses(*, count: int, random: np.random.Generator) -> Vector:
    """Between the specification's stops, and such that gravity turns in the sensor's frame."""
    return random.uniform([-1.2, -2.0, 0.1], [1.2, 1.0, 2.6], (count, 3))


class Controller:
    """A running instance."""

    def __init__(self, instance: Instance, start: dict[str, float]) -> None:
        self.instance, self.k = instance, 0
        for name, value in start.items():
            instance.set_start(name, value)
        instance.setup_experiment(start_time=0.0, stop_time=100.0)
        instance.enter_initialization_mode()
        instance.exit_initialization_mode()

    def step(self, inputs: dict[str, float]) -> dict[str, Vector]:
        for name, value in inputs.items():
            self.instance.set_start(name, value)
        step = self.instance.function("fmi2DoStep")
        component = c_void_p(self.instance.component)
        assert step(component, c_double(self.k * T), c_double(T), c_int(1)) == 0, self.instance.last_message()
        self.k += 1
        names = [f"{name}[{i}]" for name in ("ft.f_h", "ft.moment") for i in (1, 2, 3)]
        values = self.instance.values([*names, "ft.tare_state", "ft.fault"])
        vectors = {name: np.array([values[f"{name}[{i}]"] for i in (1, 2, 3)]) for name in ("ft.f_h", "ft.moment")}
        return {**vectors, "state": np.array(values["ft.tare_state"]), "fault": np.array(values["ft.fault"])}


def sensed(q: Vector, force: Vector, torque: Vector) -> dict[str, float]:
    return {**vector("q", q), **vector("ft.force", force), **vector("ft.torque", torque)}


def test_the_wrench_at_the_handle_is_pinocchio_s(archive: Archive) -> None:
    random = np.random.default_rng(21)
    for _ in range(20):
        sensor = Sensor(random=random)
        sensor.bias_force = sensor.bias_torque = np.zeros(3)
        with Instance(archive, "controller") as instance:
            controller = Controller(instance, {**sensor.parameters(), "engage": False})
            for q in poses(count=5, random=random):
                force, moment = random.uniform(-60.0, 60.0, 3), random.uniform(-3.0, 3.0, 3)
                got = controller.step(sensed(q, *sensor.reading(q, force=force, moment=moment)))
                # Rounding: some 1e-16 of 60 N and of 60 N at 0.3 m, through a dozen operations.
                assert np.abs(got["ft.f_h"] - force).max() < 1e-13
                assert np.abs(got["ft.moment"] - moment).max() < 1e-13


def test_an_identified_and_tared_sensor_leaves_less_than_50_millinewtons_in_20_poses(archive: Archive) -> None:
    random = np.random.default_rng(22)
    sensor = Sensor(random=random)

    def noisy(q: Vector, force: Vector) -> tuple[Vector, Vector]:
        f, n = sensor.reading(q, force=force, moment=np.zeros(3))
        return f + 0.1 * random.standard_normal(3), n + 0.005 * random.standard_normal(3)

    # What a user does: 100 readings in each of 12 poses, nobody touching.
    q = np.repeat(poses(count=12, random=random), 100, axis=0)
    readings = [noisy(row, np.zeros(3)) for row in q]
    found = tool.identify(
        R=tool.orientation(q=q, mount=tuple(sensor.mount)),
        force=np.array([f for f, _ in readings]),
        torque=np.array([n for _, n in readings]),
    )
    start = sensor.parameters() | {"ft.mass": found.mass, **vector("ft.cog", found.cog), "engage": False}
    with Instance(archive, "controller") as instance:
        controller = Controller(instance, start)
        rest = poses(count=1, random=random)[0]
        for _ in range(500):
            got = controller.step({**sensed(rest, *noisy(rest, np.zeros(3))), "ft.tare": True})
        assert got["state"] == 2
        residuals = []
        for q_there in poses(count=20, random=random):
            force = random.uniform(-30.0, 30.0, 3)
            seen = [controller.step(sensed(q_there, *noisy(q_there, force)))["ft.f_h"] for _ in range(300)]
            residuals.append(float(np.linalg.norm(np.mean(seen, axis=0) - force)))
        assert max(residuals) <= 0.05, residuals


def test_every_way_to_be_not_finite_is_named_and_lets_no_force_through(archive: Archive) -> None:
    zero = np.zeros(3)
    with Instance(archive, "controller") as instance:
        controller = Controller(instance, {"ft.source": 2, "ft.recovery_time": 0.0})
        for name in ("ft.force[1]", "ft.force[3]", "ft.torque[2]"):
            for value in (np.nan, np.inf, -np.inf):
                got = controller.step({**sensed(np.array([0.0, -1.48, 1.7]), zero + 5.0, zero), name: value})
                assert got["fault"] == 1
                assert not got["ft.f_h"].any()
                got = controller.step(sensed(np.array([0.0, -1.48, 1.7]), zero + 5.0, zero))
                assert got["fault"] == 0
                assert got["ft.f_h"].all()
