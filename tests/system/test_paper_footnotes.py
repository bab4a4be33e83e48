"""What footnote 2 of the paper says of the arm: its gears make it almost linear in the joints, not at the handle.

The engine holds the specification's table of the arm; `test_arm_oracles.py` holds the FMU against it.
"""

import numpy as np
import pytest

from oracles.engines import Arm, Pinocchio, State

POSES = 2000
#: The stops of the specification.
LOW, HIGH = np.array([-1.2, -2.0, 0.1]), np.array([1.2, 1.0, 2.6])
#: Farther from a singularity than this, m/rad.
SIGMA = 0.1


def spread(payload: float) -> tuple[list[float], float, float]:
    """Over random poses with `payload` (kg): what the diagonal of M varies by, over its largest value, joint by joint;
    the largest coupling |M_23|/√(M_22 M_33); the largest eigenvalue of Λ over the smallest one of any pose."""
    random, engine = np.random.default_rng(3), Pinocchio()
    at_rest = np.zeros(3)
    diagonals, couplings, masses = [], [], []
    for _ in range(POSES):
        q = random.uniform(LOW, HIGH)
        state = State(q=q, dq=at_rest, payload=payload, gravity=at_rest, tau_a=at_rest, f_h=at_rest, f_d=at_rest)
        terms = engine(state)
        M, J = terms.M, terms.J
        diagonals.append(np.diag(M))
        couplings.append(abs(M[1, 2]) / np.sqrt(M[1, 1] * M[2, 2]))
        if np.linalg.svd(J, compute_uv=False)[-1] > SIGMA:
            masses.append(np.linalg.eigvalsh(np.linalg.inv(J @ np.linalg.inv(M) @ J.T)))
    low, high = np.min(diagonals, axis=0), np.max(diagonals, axis=0)
    return list((high - low) / high), max(couplings), float(np.max(masses) / np.min(masses))


def test_the_gears_make_the_empty_arm_almost_linear_in_its_joints_and_not_at_the_handle() -> None:
    varies, coupling, at_the_handle = spread(0.0)
    assert varies == pytest.approx([0.30, 0.06, 0.0], abs=0.01)
    assert coupling == pytest.approx(0.056, abs=0.002)
    assert at_the_handle > 40.0
    # The rotors' share of joints 2 and 3, n² I_r over M's diagonal, in the pose that has most of the links.
    straight = Pinocchio()(
        State(q=np.array([0.0, 0.0, 0.1]), dq=np.zeros(3), payload=0.0, gravity=np.zeros(3),
              tau_a=np.zeros(3), f_h=np.zeros(3), f_d=np.zeros(3))
    )  # fmt: skip
    share = np.array([600.0, 354.0]) ** 2 * 2.0e-5 / np.diag(straight.M)[1:]
    assert share == pytest.approx([0.90, 0.96], abs=0.01)
    assert Arm().armature()[1] == pytest.approx(7.2)


def test_twenty_five_kilograms_at_the_pad_undo_that() -> None:
    varies, coupling, _ = spread(25.0)
    assert varies == pytest.approx([0.86, 0.51, 0.0], abs=0.01)
    assert coupling > 0.6
