"""The arm in two foreign engines: Pinocchio, built here from the specification's table, and MuJoCo, from `arm.xml`.

Neither sees a number of the FMU. Both get a state and what acts, and give the terms of
M ddq + C dq + g = τ_a + J_hᵀ f_h + J_pᵀ f_d, without friction, stops and contact.
"""

from dataclasses import dataclass, replace
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
from numpy.typing import NDArray

Vector = NDArray[np.float64]
ARM_XML = Path(__file__).with_name("arm.xml")


@dataclass(frozen=True, kw_only=True)
class Link:
    """One link: mass (kg), centre of mass (m) in its frame, inertia tensor about it (kg·m²)."""

    m: float
    x: float
    z: float
    I_xx: float
    I_yy: float
    I_zz: float
    I_xz: float

    def tensor(self) -> Vector:
        """The inertia tensor; I_xz is its element, not minus its element."""
        return np.array([[self.I_xx, 0.0, self.I_xz], [0.0, self.I_yy, 0.0], [self.I_xz, 0.0, self.I_zz]])


@dataclass(frozen=True, kw_only=True)
class Arm:
    """docs/specification.md section 4: lengths (m), points of link 3 as (x, z), links, rotors (kg·m²) and gears."""

    A1: float = 0.06
    L1: float = 0.32
    handle: tuple[float, float] = (0.36, 0.0)
    pad: tuple[float, float] = (0.36, -0.12)
    links: tuple[Link, Link, Link] = (
        Link(m=4.0, x=0.03, z=0.02, I_xx=0.012, I_yy=0.012, I_zz=0.010, I_xz=0.0),
        Link(m=3.5, x=0.20, z=0.01, I_xx=0.006, I_yy=0.035, I_zz=0.034, I_xz=0.001),
        Link(m=2.5, x=0.18, z=-0.03, I_xx=0.004, I_yy=0.028, I_zz=0.027, I_xz=-0.001),
    )
    rotor: tuple[float, float, float] = (2.0e-5, 2.0e-5, 2.0e-5)
    gear: tuple[float, float, float] = (354.0, 600.0, 354.0)

    def armature(self) -> Vector:
        """Rotor inertia as the joint feels it (kg·m²)."""
        return np.array(self.rotor) * np.array(self.gear) ** 2


@dataclass(frozen=True, kw_only=True)
class State:
    """Where the arm is and what acts on it, base frame: angles (rad), velocities (rad/s), payload at the pad (kg),
    gravity (m/s²), torques (N·m), forces at handle and pad (N)."""

    q: Vector
    dq: Vector
    payload: float
    gravity: Vector
    tau_a: Vector
    f_h: Vector
    f_d: Vector


@dataclass(frozen=True, kw_only=True)
class Terms:
    """What an engine says of a state."""

    M: Vector
    C_dq: Vector
    g: Vector
    p: Vector
    p_pad: Vector
    J: Vector
    ddq: Vector


class Pinocchio:
    """Composite rigid bodies for M, recursive Newton–Euler for C dq and g, articulated bodies for ddq."""

    def __init__(self, arm: Arm | None = None) -> None:
        self.arm = arm or Arm()
        self.model = pinocchio.Model()
        down = np.array([0.0, -1.0, 0.0])
        joints = (
            (pinocchio.JointModelRZ(), np.zeros(3)),
            (pinocchio.JointModelRevoluteUnaligned(down), np.array([self.arm.A1, 0.0, 0.0])),
            (pinocchio.JointModelRevoluteUnaligned(down), np.array([self.arm.L1, 0.0, 0.0])),
        )
        parent = 0
        for i, ((joint, origin), link) in enumerate(zip(joints, self.arm.links, strict=True)):
            parent = self.model.addJoint(parent, joint, pinocchio.SE3(np.eye(3), origin), f"joint{i + 1}")
            body = pinocchio.Inertia(link.m, np.array([link.x, 0.0, link.z]), link.tensor())
            self.model.appendBodyToJoint(parent, body, pinocchio.SE3.Identity())
        self.model.armature = self.arm.armature()
        self.frames = {}
        for name, (x, z) in (("handle", self.arm.handle), ("pad", self.arm.pad)):
            place = pinocchio.SE3(np.eye(3), np.array([x, 0.0, z]))
            frame = pinocchio.Frame(name, parent, 0, place, pinocchio.FrameType.OP_FRAME)
            self.frames[name] = self.model.addFrame(frame)
        self.unloaded = self.model.inertias[3].copy()

    def __call__(self, state: State) -> Terms:
        """The terms at `state`."""
        model, q, dq = self.model, state.q, state.dq
        x, z = self.arm.pad
        point = pinocchio.Inertia(state.payload, np.array([x, 0.0, z]), np.zeros((3, 3)))
        model.inertias[3] = self.unloaded + point if state.payload else self.unloaded
        model.gravity.linear = state.gravity
        data = model.createData()
        pinocchio.forwardKinematics(model, data, q)
        pinocchio.updateFramePlacements(model, data)
        p = {name: data.oMf[frame].translation.copy() for name, frame in self.frames.items()}
        J = {
            name: pinocchio.computeFrameJacobian(model, data, q, frame, pinocchio.LOCAL_WORLD_ALIGNED)[:3].copy()
            for name, frame in self.frames.items()
        }
        M = np.triu(pinocchio.crba(model, data, q))
        g = pinocchio.computeGeneralizedGravity(model, data, q).copy()
        bias = pinocchio.nonLinearEffects(model, data, q, dq).copy()
        model.gravity.linear = np.zeros(3)
        C_dq = pinocchio.nonLinearEffects(model, data, q, dq).copy()
        # Newton–Euler adds the two: a check of this use of the library, to rounding.
        assert np.abs(C_dq + g - bias).max() <= 1e-13 * max(np.abs(bias).max(), 1.0)
        model.gravity.linear = state.gravity
        torque = state.tau_a + J["handle"].T @ state.f_h + J["pad"].T @ state.f_d
        ddq = pinocchio.aba(model, data, q, dq, torque).copy()
        M = M + np.triu(M, 1).T
        return Terms(M=M, C_dq=C_dq, g=g, p=p["handle"], p_pad=p["pad"], J=J["handle"], ddq=ddq)


class MuJoCo:
    """`arm.xml` with friction, damping, stops and contact switched off."""

    def __init__(self) -> None:
        self.model = mujoco.MjModel.from_xml_path(str(ARM_XML))
        off = mujoco.mjtDisableBit
        self.model.opt.disableflags = int(off.mjDSBL_CONSTRAINT) | int(off.mjDSBL_DAMPER)
        self.data = mujoco.MjData(self.model)
        self.payload = self.model.body("payload").id

    def _forward(self, state: State) -> mujoco.MjData:
        model, data = self.model, self.data
        model.body_mass[self.payload] = state.payload
        mujoco.mj_setConst(model, data)
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = state.q, state.dq
        model.opt.gravity[:] = state.gravity
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        data.qfrc_applied[:] = state.tau_a
        for body, site, force in (("link3", "handle", state.f_h), ("payload", "pad", state.f_d)):
            point, torque = data.site(site).xpos.copy(), np.zeros(3)
            mujoco.mj_applyFT(model, data, force, torque, point, model.body(body).id, data.qfrc_applied)
        mujoco.mj_forward(model, data)
        return data

    def __call__(self, state: State) -> Terms:
        """The terms at `state`."""
        still = self._forward(replace(state, dq=np.zeros(3)))
        g = still.qfrc_bias.copy()
        C_dq = self._forward(replace(state, gravity=np.zeros(3))).qfrc_bias.copy()
        data = self._forward(state)
        M, J = np.zeros((3, 3)), np.zeros((3, 3))
        mujoco.mj_fullM(self.model, data, M)
        mujoco.mj_jacSite(self.model, data, J, None, self.model.site("handle").id)
        p, p_pad = data.site("handle").xpos.copy(), data.site("pad").xpos.copy()
        return Terms(M=M, C_dq=C_dq, g=g, p=p, p_pad=p_pad, J=J, ddq=data.qacc.copy())
