"""What the arm is at its handle: Jacobian and effective mass, from the plant's recorded angles and parameters.

Written from docs/specification.md section 4, beside the plant's own: yaw q_1 about z, pitch q_2 and q_3 about −y. In
the frame that turns with q_1 (r outwards, y' sideways, z up) yaw and pitch do not mix, in M nor in J.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exo.recording import Recording

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Handle:
    """J (n, 3, 3) in m, M (n, 3, 3) in kg·m² with rotors and a held payload, and Λ = (J M⁻¹ Jᵀ)⁻¹ (n, 3, 3) in kg."""

    J: Array
    M: Array

    @property
    def Lambda(self) -> Array:  # noqa: N802, the paper's symbol
        """Mass that a force at the handle feels; numpy's LinAlgError where a stretched elbow makes J singular."""
        inverse = np.linalg.inv(self.J)
        return np.asarray(np.swapaxes(inverse, 1, 2) @ self.M @ inverse)


def handle_of(run: Recording, *, plant: str) -> Handle:
    """The handle at every tick of the recording."""
    q = np.stack([run[f"{plant}.q_joint[{i}]"] for i in (1, 2, 3)], axis=1)
    value = {name: run.parameter(f"{plant}.{name}") for name in ("A1", "L1", "handle.x", "handle.z", "pad.x", "pad.z")}
    parts = {name: [run.parameter(f"{plant}.{name}[{i}]") for i in (1, 2, 3)] for name in LINK}
    A1, L1 = value["A1"], value["L1"]
    elbow = _along(q[:, 1], L1, 0.0)

    def on_forearm(x: float, z: float) -> tuple[Array, Array]:
        """Place (r, z) of a point of link 3 and its derivatives by q_2 and q_3 (n, 2, 2)."""
        own = _along(q[:, 1] + q[:, 2], x, z)
        place = elbow + own + np.array([A1, 0.0])
        return place, np.stack([_turned(elbow + own), _turned(own)], axis=2)

    upper = _along(q[:, 1], parts["link.x"][1], parts["link.z"][1])
    upper_moves = np.stack([_turned(upper), np.zeros_like(upper)], axis=2)
    held = run.parameter(f"{plant}.payload.m") * np.asarray(run[f"{plant}.attached"], dtype=np.float64)
    bodies: list[tuple[Array, Array, Array]] = [
        (np.full(len(q), parts["link.m"][1]), upper + np.array([A1, 0.0]), upper_moves),
        (np.full(len(q), parts["link.m"][2]), *on_forearm(parts["link.x"][2], parts["link.z"][2])),
        (held, *on_forearm(value["pad.x"], value["pad.z"])),
    ]
    yaw = parts["link.I_zz"][0] + parts["link.m"][0] * parts["link.x"][0] ** 2 + np.zeros(len(q))
    pitch = np.zeros((len(q), 2, 2))
    for m, place, moves in bodies:
        yaw += m * place[:, 0] ** 2
        pitch += m[:, None, None] * (np.swapaxes(moves, 1, 2) @ moves)
    for link, angle, turning in ((1, q[:, 1], [1.0, 0.0]), (2, q[:, 1] + q[:, 2], [1.0, 1.0])):
        s, c = np.sin(angle), np.cos(angle)
        I_xx, I_xz, I_zz = (parts[f"link.I_{name}"][link] for name in ("xx", "xz", "zz"))
        yaw += I_xx * s**2 + 2.0 * I_xz * s * c + I_zz * c**2
        pitch += parts["link.I_yy"][link] * np.outer(turning, turning)
    M = np.zeros((len(q), 3, 3))
    M[:, 0, 0], M[:, 1:, 1:] = yaw, pitch
    M += np.diag([gear**2 * rotor for gear, rotor in zip(parts["gear"], parts["rotor.I"], strict=True)])

    place, moves = on_forearm(value["handle.x"], value["handle.z"])
    J = np.zeros((len(q), 3, 3))
    s, c = np.sin(q[:, 0]), np.cos(q[:, 0])
    J[:, 0, 0], J[:, 1, 0] = -s * place[:, 0], c * place[:, 0]
    J[:, 0, 1:], J[:, 1, 1:], J[:, 2, 1:] = c[:, None] * moves[:, 0], s[:, None] * moves[:, 0], moves[:, 1]
    return Handle(J=J, M=M)


LINK = ("link.m", "link.x", "link.z", "link.I_xx", "link.I_yy", "link.I_zz", "link.I_xz", "gear", "rotor.I")


def _along(angle: Array, x: float, z: float) -> Array:
    """(r, z) of the point (x, z) of a link at this pitch (n, 2)."""
    s, c = np.sin(angle), np.cos(angle)
    return np.stack([x * c - z * s, x * s + z * c], axis=1)


def _turned(arm: Array) -> Array:
    """Derivative of a lever arm (r, z) by its pitch."""
    return np.stack([-arm[:, 1], arm[:, 0]], axis=1)
