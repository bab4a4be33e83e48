"""FMUs that are wired: what steps in which order, and where every input comes from."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import isfinite
from os import PathLike
from types import MappingProxyType
from typing import Any, get_args

from exo import preflight
from exo.api.fmu import Fmu, load
from exo.api.frozen import Picklable
from exo.errors import ScenarioError, close_matches
from exo.fmu import Archive
from exo.naming import elements, expand_wires
from exo.plan import Plan
from exo.scenario import DERIVED, MINUS, PROFILE, Coupling

COUPLINGS: tuple[Coupling, ...] = get_args(Coupling)
COMPONENT = re.compile(r"[A-Za-z_]\w*")


@dataclass(frozen=True, kw_only=True, repr=False)
class System(Picklable):
    """Coupled FMUs: what `exo.couple` gives and `exo.simulate` runs."""

    #: By component name, in the order in which they step.
    fmus: Mapping[str, Fmu]
    #: Input → output, arrays by element.
    wires: Mapping[str, str]
    #: Communication step (s).
    step: float
    coupling: Coupling
    #: Inputs that come one step late under `one_sample_delay`.
    delayed: tuple[str, ...]
    #: Variables that are recorded besides outputs and wired inputs.
    recorded: tuple[str, ...]
    #: What may be a slip, a sentence each: a step that does not divide a controller's sample period.
    notes: tuple[str, ...] = ()

    @property
    def unwired(self) -> tuple[str, ...]:
        """Inputs that no wire feeds: `exo.simulate` may give them values, else they keep the FMUs' start values."""
        every = (f"{component}.{name}" for component, fmu in self.fmus.items() for name in fmu.inputs)
        return tuple(name for name in every if name not in self.wires)

    def __repr__(self) -> str:
        order = " → ".join(f"{name} ({fmu.path.name})" for name, fmu in self.fmus.items())
        rows = [f"{order}, every {self.step:g} s, {self.coupling}"]
        rows += [f"  {target} = {source}" for target, source in self.wires.items()]
        rows += [f"  {name}: at its start value" for name in self.unwired]
        rows += [f"  note: {note}" for note in self.notes]
        return "\n".join(rows)

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        import html  # noqa: PLC0415

        import pandas as pd  # noqa: PLC0415

        rows = [*self.wires.items(), *((name, "(start value)") for name in self.unwired)]
        table = pd.DataFrame(rows, columns=["input", "source"])
        notes = "".join(f"<p>{html.escape(note)}</p>" for note in self.notes)
        return f"<p>{html.escape(repr(self).splitlines()[0])}</p>{table.to_html(index=False)}{notes}"


def couple(
    fmus: Mapping[str, Fmu | str | PathLike[str]],
    *,
    wires: Mapping[str, str] | None = None,
    step: float | None = None,
    coupling: Coupling = "zero_delay",
    delayed: Iterable[str] = (),
    record: Iterable[str] = (),
) -> System:
    """Wires FMUs.

    `fmus` are FMUs, or what `exo.load` takes, by component name, in the order in which they step. `wires` are
    `"plant.tau_a": "controller.tau_a"`, input: output; `"plant.q[1..3]"` stands for three elements; a minus before an
    output of type Real turns its sign over. `step` (s) may be left out where FMUs propose one and none another.
    `coupling` is `zero_delay` (each sees what those before it have just put out), `one_sample_delay` (the same, but
    inputs in `delayed` come a step later) or `exchange_at_once` (all outputs are read before anything steps).
    Nothing is iterated: an input whose source steps later, or is of the same FMU, gets what that put out a step before.
    `record` names variables that are no outputs, to be recorded as well: `"plant.x"`, `"plant.p[1..3]"`.

    ScenarioError for a name or wire that does not fit; FmuError for a file, or variables that cannot be wired, such as
    those of two units.
    """
    if not isinstance(fmus, Mapping) or not fmus:
        raise ScenarioError(f'couple: got {fmus!r:.80}; expected FMUs by name, as {{"plant": "Testbed.fmu"}}')
    for name in fmus:
        if not isinstance(name, str) or not COMPONENT.fullmatch(name) or name in (PROFILE, DERIVED):
            raise ScenarioError(
                f"couple: component {name!r}: expected letters, digits and _, not {PROFILE} or {DERIVED}"
            )
    if coupling not in COUPLINGS:
        raise ScenarioError(f"coupling {coupling!r}: expected one of {', '.join(COUPLINGS)}")
    loaded = {name: one if isinstance(one, Fmu) else load(one) for name, one in fmus.items()}
    system = System(
        fmus=MappingProxyType(loaded),
        wires=MappingProxyType(_wires(wires or {}, loaded)),
        step=_step(step, loaded),
        coupling=coupling,
        delayed=_listed("delayed", delayed),
        recorded=_recorded(record, loaded),
    )
    for name in system.delayed:
        if name not in system.wires:
            raise ScenarioError(f"delayed: {name}: no wired input{close_matches(name, system.wires)}")
    late = coupling == "one_sample_delay"
    if late != bool(system.delayed):
        told = "without delayed inputs it is zero_delay" if late else "delayed inputs belong to one_sample_delay"
        raise ScenarioError(f"coupling {coupling!r} with delayed = {[*system.delayed]}: {told}; expected both or none")
    plan, archives = plan_of(system, duration=system.step), archives_of(system)
    preflight.one_run(plan=plan, archives=archives, owner="couple")
    return replace(system, notes=tuple(preflight.timing({"couple": plan}, archives)))


def plan_of(system: System, *, duration: float) -> Plan:
    """What runs, before inputs and parameters are set. Components bear their own names as archives."""
    return Plan(
        components={name: name for name in system.fmus},
        parameters={},
        inputs=dict(system.wires),
        delayed=system.delayed,
        profiles={},
        coupling=system.coupling,
        duration=duration,
        step=system.step,
        recorded=system.recorded,
    )


def archives_of(system: System) -> dict[str, Archive]:
    """An archive for each component, none of them open: two of one FMU share no library."""
    return {name: Archive(fmu.path, strict=False) for name, fmu in system.fmus.items()}


def _wires(wires: Mapping[str, str], fmus: Mapping[str, Fmu]) -> dict[str, str]:
    if not isinstance(wires, Mapping):
        raise ScenarioError(
            f'wires: got a value of type {type(wires).__name__}; expected {{"plant.tau_a": "controller.tau_a"}}'
        )
    for target, source in wires.items():
        for name in (target, source):
            component, dot, variable = str(name).removeprefix(MINUS if name is source else "").partition(".")
            if not isinstance(name, str) or not dot or not variable:
                raise ScenarioError(f"wires: {target!r} = {source!r}: expected component.input = component.output")
            if component not in fmus:
                raise ScenarioError(f"wires: {name}: no component {component}{close_matches(component, fmus)}")
    try:
        return dict(expand_wires(dict(wires)))
    except ValueError as error:
        raise ScenarioError(f"wires: {error}") from error


def _listed(what: str, names: Iterable[str]) -> tuple[str, ...]:
    one_or_more = [names] if isinstance(names, str) else names
    listed = [*one_or_more] if isinstance(one_or_more, Iterable) else [None]
    if not all(isinstance(name, str) for name in listed):
        raise ScenarioError(f"{what}: got {names!r:.60}; expected names as component.variable")
    try:
        return tuple(one for name in listed for one in elements(name))
    except ValueError as error:
        raise ScenarioError(f"{what}: {error}") from error


def _recorded(names: Iterable[str], fmus: Mapping[str, Fmu]) -> tuple[str, ...]:
    """What is not recorded anyway; Strings are no signals."""
    found: dict[str, None] = {}
    for name in _listed("record", names):
        component, _, variable = name.partition(".")
        if component not in fmus:
            raise ScenarioError(f"record: {name}: no component {component}{close_matches(component, fmus)}")
        declared = fmus[component][variable]
        if declared.type == "String" or declared.causality == "input":
            raise ScenarioError(
                f"record: {name}: expected a variable that is a number and no input, this is "
                f"{declared.causality} of type {declared.type}; a wired input is recorded by itself"
            )
        if declared.causality != "output":
            found[name] = None
    return tuple(found)


def _step(step: Any, fmus: Mapping[str, Fmu]) -> float:
    if step is None:
        proposed = {fmu.step for fmu in fmus.values() if fmu.step}
        if len(proposed) != 1:
            told = ", ".join(f"{name} {fmu.step:g} s" for name, fmu in fmus.items() if fmu.step) or "none proposes one"
            raise ScenarioError(f"step: got none; expected the communication step in s ({told})")
        return float(proposed.pop())
    return positive("step", step)


def positive(name: str, value: Any) -> float:
    """A time above 0 s as a number. ScenarioError names it, if it is none."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ScenarioError(f"{name} = {value!r:.40}: expected a time above 0 s") from None
    if isinstance(value, bool | str) or not (isfinite(number) and number > 0.0):
        raise ScenarioError(f"{name} = {value!r:.40}: expected a time above 0 s")
    return number
