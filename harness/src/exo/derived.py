"""Signals that no FMU shows, from those that they show: columns `derived.<name>` of a recording.

A scenario asks for them with `derived = ["f_ed"]`; metrics, figures and `signals` then name the columns.

| name | columns | unit | what |
|---|---|---|---|
| `tau_ed` | `derived.tau_ed` | N | effective disturbance of the testbed, eq:effective_dist |
| `f_ed` | `derived.f_ed[1..3]` | N | the same of the arm at its handle |
| `x_nr` | `derived.x_nr` | 1 | ‖(e_nr, de_nr)‖ of testbed or arm, metres and metres a second added up as in thm:pm |
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo.errors import ScenarioError, close_matches
from exo.handle import handle_of
from exo.recording import Recording
from exo.scenario import DERIVED

Array = NDArray[np.float64]
AXES = (1, 2, 3)


@dataclass(frozen=True)
class Derived:
    """Names of the columns without `derived.`, their unit, and what computes them, in the names' order."""

    columns: tuple[str, ...]
    unit: str
    compute: Callable[[Recording], Iterable[Array]]


def _rate(values: Array, step: float) -> Array:
    """Mean rate over the step that begins at each tick; the last tick repeats the one before."""
    rate = np.diff(values, axis=0) / step
    return np.concatenate([rate, rate[-1:]])


def _tau_ed(run: Recording) -> Iterable[Array]:
    """τ_ed = (M/M_n)(τ_h − D_n dq) + τ_a − M ddq.

    eq:effective_dist with τ_h + τ_d = M ddq − τ_a put in: neither friction nor wall is needed. ddq is the mean over the
    step, in which τ_a and τ_h are held.
    """
    M, M_n, D_n = (run.parameter(key) for key in ("plant.M", "controller.M_n", "controller.D_n"))
    wanted = M / M_n * (run["plant.tau_h"] - D_n * run["plant.dq"])
    yield wanted + run["plant.tau_a"] - M * _rate(run["plant.dq"], run.step)


def _f_ed(run: Recording) -> Iterable[Array]:
    """f_ed = Λ Λ_n⁻¹ (f_h − D_n dp) + f_a − Λ ddp, as `_tau_ed`, f_a = J⁻ᵀ τ being what the drives really gave."""
    handle = handle_of(run, plant="plant")
    dp, f_h, tau_a, arrived = (
        np.stack([run[f"plant.{name}[{i}]"] for i in AXES], axis=1) for name in ("dp", "f_h", "tau_a", "tau_applied")
    )
    if run.parameter("plant.drive.cutoff") > 0.0:
        tau_a = 0.5 * (arrived + np.concatenate([arrived[1:], arrived[-1:]]))
    Lambda_n, D_n = (np.array([run.parameter(f"controller.{name}[{i}]") for i in AXES]) for name in ("Lambda_n", "D_n"))
    f_a = np.linalg.solve(np.swapaxes(handle.J, 1, 2), tau_a[:, :, None])
    inert = ((f_h - D_n * dp) / Lambda_n - _rate(dp, run.step))[:, :, None]
    yield from (handle.Lambda @ inert + f_a)[:, :, 0].T


def _x_nr(run: Recording) -> Iterable[Array]:
    """‖x_nr‖ = √(Σ e² + Σ de²), x_nr = (e_nr, de_nr); de_nr by central differences."""
    names = [name for name in run.columns if name.partition("[")[0] == "controller.e_nr"]
    errors = [run[name] for name in names or ["controller.e_nr"]]
    yield np.sqrt(sum(e**2 + np.gradient(e, run.step) ** 2 for e in errors))


SIGNALS: Mapping[str, Derived] = {
    "tau_ed": Derived(("tau_ed",), "N", _tau_ed),
    "f_ed": Derived(tuple(f"f_ed[{i}]" for i in AXES), "N", _f_ed),
    "x_nr": Derived(("x_nr",), "", _x_nr),
}


def columns(names: Iterable[str], *, owner: str) -> list[str]:
    """The columns that these signals give; unknown ones are an error that names `owner`."""
    found: list[str] = []
    for name in names:
        if name not in SIGNALS:
            raise ScenarioError(f"{owner}: unknown derived signal {name}{close_matches(name, SIGNALS)}")
        found += [f"{DERIVED}.{column}" for column in SIGNALS[name].columns]
    return found


def added(run: Recording, names: Iterable[str]) -> Recording:
    """The recording with these signals. An `ExoError` says which column or parameter a signal lacks."""
    names = list(names)
    if not names:
        return run
    more: dict[str, Array] = {}
    units: dict[str, str] = {}
    for name in names:
        signal = SIGNALS[name]
        try:
            computed = list(signal.compute(run))
        except np.linalg.LinAlgError as error:
            raise ScenarioError(
                f"derived signal {name}: {error}; expected an arm whose elbow is bent at every tick"
            ) from error
        for column, values in zip(signal.columns, computed, strict=True):
            more[f"{DERIVED}.{column}"] = np.ascontiguousarray(values)
            units[f"{DERIVED}.{column}"] = signal.unit
    # The run's own columns may be taken from it when they are asked for.
    return replace(run, columns=_Both(more, run.columns), units={**run.units, **units})


class _Both(Mapping[str, NDArray[Any]]):
    """Two mappings as one; the first one's values go before."""

    def __init__(self, first: Mapping[str, NDArray[Any]], second: Mapping[str, NDArray[Any]]) -> None:
        self._first, self._second = first, second

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._first[name] if name in self._first else self._second[name]

    def __contains__(self, name: object) -> bool:
        return name in self._first or name in self._second

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys([*self._second, *self._first]))

    def __len__(self) -> int:
        return len(set(self._first) | set(self._second))
