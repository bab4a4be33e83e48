"""The coupling between nominal and robot: its spring, its reaction under a load, its torque while it fades in."""

import numpy as np

from exo.metrics.basic import mean_rate, values, window
from exo.metrics.registry import metric
from exo.recording import Recording


@metric
def max_spring_force(run: Recording, *, error: str, K: str, K_P: str) -> float:
    """max |K K_P e_nr| (N): what the spring between nominal and robot ever asks for."""
    return run.parameter(K) * run.parameter(K_P) * float(np.max(np.abs(run[error])))


@metric
def spring_share(run: Recording, *, controller: str) -> float:
    """max |K K_P e_nr| / f_max over axes and ticks: 1 when the bound is reached."""
    return max(
        max_spring_force(run, error=f"{controller}.e_nr[{i}]", K=f"{controller}.K[{i}]", K_P=f"{controller}.K_P[{i}]")
        / run.parameter(f"{controller}.f_max[{i}]")
        for i in (1, 2, 3)
    )


@metric
def ramp_excess(run: Recording, *, controller: str, after: float, before: float) -> float:
    """What a joint's torque step exceeds its bound by while the authority a rises over n ticks (N·m). With tau = a d
    tau_k − tau_{k−1} = (a_k − a_{k−1}) d_k + a_{k−1} (d_k − d_{k−1}): |step| ≤ |d_k|/n + a_{k−1} |d_k − d_{k−1}|."""
    later = np.flatnonzero(window(run.time, after=after, before=before))
    earlier = later - 1
    n = run.parameter(f"{controller}.engage_time") / run.parameter(f"{controller}.T")
    authority = run[f"{controller}.authority"][earlier]

    def excess(joint: int) -> float:
        tau, demand = run[f"{controller}.tau_a[{joint}]"], run[f"{controller}.tau_demand[{joint}]"]
        bound = np.abs(demand[later]) / n + authority * np.abs(demand[later] - demand[earlier])
        return float(np.max(np.abs(tau[later] - tau[earlier]) - bound))

    return max(excess(joint) for joint in (1, 2, 3))


@metric
def drift_over_prediction(
    run: Recording, *, controller: str, axis: int, moving: tuple[float, float], loaded: tuple[float, float]
) -> float:
    """Velocity of the handle over `moving` (s, s) divided by −α f_a/(K D_n), f_a its mean over `loaded` (s, s): what
    eq:obs_dyn says of a nominal on which nothing acts but the reaction of a constant load."""
    value = {name: run.parameter(f"{controller}.{name}[{axis}]") for name in ("K", "D_n")}
    f_a = np.mean(values(run, f"{controller}.f_a[{axis}]", *loaded))
    predicted = -run.parameter(f"{controller}.alpha") * f_a / (value["K"] * value["D_n"])
    return mean_rate(run, column=f"{controller}.p[{axis}]", first=moving[0], last=moving[1]) / float(predicted)


@metric
def joint_drift_over_prediction(run: Recording, *, controller: str, joint: int, moving: tuple[float, float]) -> float:
    """Velocity of a joint over `moving` (s, s) divided by −α τ_a/(K D_n), τ_a its mean meanwhile: what eq:obs_dyn says
    of a nominal in joint space on which nothing acts but the reaction of a constant load."""
    K, D_n = run.parameter(f"{controller}.joint.K"), run.parameter(f"{controller}.joint.D_n[{joint}]")
    tau_a = np.mean(values(run, f"{controller}.tau_a[{joint}]", *moving))
    predicted = -run.parameter(f"{controller}.alpha") * tau_a / (K * D_n)
    return mean_rate(run, column=f"{controller}.q[{joint}]", first=moving[0], last=moving[1]) / float(predicted)
