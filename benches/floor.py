"""Each FMU beside the FMI floor: `floor.c`, an FMU that does nothing but keep and give back what is set.

The floor stands in an archive with the same variables, and is called by the same loop in C with the same rows: the
inputs that the FMU got in a scenario are set, a step is made, all outputs are got.
"""

import zipfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import numpy as np

from benches import c_loop, native
from benches.row import Bench, Found, Row
from benches.turns import in_turns, pinned
from exo import master
from exo.coupled import Coupled
from exo.fmu import Archive, Instance
from exo.loop import Part
from exo.plan import Plan
from exo.scenario import load

#: Scenario, case, which components, steps: all of them move.
MOVING = (
    ("wall", "passive_bounded_5_0.5", ("controller", "plant"), 5000),
    ("arm_payload", "passive_bounded_25kg", ("controller", "plant", "operator"), 10_000),
    ("arm_both", "equal", ("plant",), 5000),
)
#: The exporter's own example.
SMALLEST = "test/integrator.fmu"
#: How often the floor does its work, which is over soon, in a round.
AGAIN = 10
#: `MOST` of floor.c.
MOST = 2048
OFFERED = ("canGetAndSetFMUstate", "canSerializeFMUstate", "providesDirectionalDerivative")


def measure(bench: Bench) -> Iterator[Found]:
    """A row for each FMU."""
    archives(bench, bench.work / "floors")
    for name, case, components, steps in MOVING:
        scenario = load(name)
        chosen = next(one for one in scenario.cases if one.id == case)
        plan = master.plan(scenario=scenario, case=chosen)
        plan = replace(plan, duration=steps * plan.step)
        with ExitStack() as stack:
            files = sorted(set(plan.components.values()))
            opened = {file: stack.enter_context(Archive(bench.fmu_dir / file)) for file in files}
            coupled = stack.enter_context(Coupled(plan, opened))
            coupled.start(plan)
            coupled.advance(engine="fmpy")
            for component in components:
                bottom = stack.enter_context(Archive(bench.work / "floors" / plan.components[component]))
                yield _row(bench, plan, coupled, component, bottom)
    with ExitStack() as stack:
        yield _smallest(bench, stack)


def _row(bench: Bench, plan: Plan, coupled: Coupled, component: str, archive: Archive) -> Found:
    """The component with the inputs that it has just got, beside its floor."""
    part = coupled._parts[component]
    inputs = {kind: rows.copy() for kind, rows in part.u.items()}

    def start() -> None:
        coupled.start(plan)
        for kind, rows in inputs.items():
            part.u[kind][:] = rows

    return _compared(bench, part, archive, steps=plan.steps, step=plan.step, start=start)


def _smallest(bench: Bench, stack: ExitStack) -> Found:
    """The exporter's smallest FMU, an integrator of one addition: what the exporter itself adds to a call."""
    steps, step = 10_000, 0.01
    archive = stack.enter_context(Archive(bench.fmu_dir / SMALLEST))
    bottom = stack.enter_context(Archive(bench.work / "floors" / Path(SMALLEST).name))
    part = Part(stack.enter_context(Instance(archive, "smallest")), inputs=["u"], outputs=["y"], steps=steps)
    part.u["Real"][:, 0] = np.sin(np.arange(steps) * step)

    def start() -> None:
        part.instance.reset()
        part.instance.setup_experiment(start_time=0.0, stop_time=steps * step)
        part.instance.enter_initialization_mode()
        part.instance.exit_initialization_mode()

    return _compared(bench, part, bottom, steps=steps, step=step, start=start)


def _compared(
    bench: Bench, part: Part, archive: Archive, *, steps: int, step: float, start: Callable[[], None]
) -> Found:
    library = c_loop.load(bench)
    with Instance(archive, "floor") as instance:
        bottom = _floor(instance, part, steps)

        def ours() -> float:
            start()
            return c_loop.alone(library, part, steps, step)

        def floor() -> float:
            return sum(c_loop.alone(library, bottom, steps, step) for _ in range(AGAIN)) / AGAIN

        with pinned():
            times = in_turns({"ours": ours, "floor": floor}, bench.rounds)
    ns = {what: 1e9 * times.median(what) / steps for what in ("ours", "floor")}
    given, taken = (sum(refs.count for refs in all_of.values()) for all_of in (part.inputs, part.outputs))
    return Row(
        name=f"{part.instance.archive.description.modelName}: set + step + get / FMI floor",
        value=times.ratio("ours", "floor"),
        spread=times.spread("ours", "floor"),
        told=f"{ns['ours']:,.0f} ns / {ns['floor']:,.0f} ns; inputs {given}, outputs {taken}, step {step:g} s",
    )


def _floor(instance: Instance, part: Part, steps: int) -> Part:
    """The same variables and rows."""
    inputs = [name for refs in part.inputs.values() for name in refs.names]
    outputs = [name for refs in part.outputs.values() for name in refs.names]
    bottom = Part(instance, inputs=inputs, outputs=outputs, steps=steps)
    for kind, rows in part.u.items():
        bottom.u[kind][:] = rows
    return bottom


def archives(bench: Bench, folder: Path) -> None:
    """Writes the floor's archive of each FMU, under the FMU's name."""
    folder.mkdir(parents=True, exist_ok=True)
    library = native.library(bench, "floor")
    for path in (*sorted(bench.fmu_dir.glob("*.fmu")), bench.fmu_dir / SMALLEST):
        with zipfile.ZipFile(path) as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        identifier = described(root, path.name)
        with zipfile.ZipFile(folder / path.name, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("modelDescription.xml", ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True))
            archive.write(library, f"binaries/{fmpy.platform}/{identifier}{fmpy.sharedLibraryExtension}")


def described(root: ElementTree.Element, name: str) -> str:
    """Makes the floor's description of an FMU's: value references from 0 for each type. Returns its identifier."""
    for element in root.iterfind("CoSimulation"):
        for offer in OFFERED:
            element.attrib.pop(offer, None)
    counts: dict[str, int] = {}
    for variable in root.iterfind("ModelVariables/ScalarVariable"):
        kind = variable[0].tag.replace("Enumeration", "Integer")
        variable.set("valueReference", str(counts.get(kind, 0)))
        counts[kind] = counts.get(kind, 0) + 1
    if max(counts.values()) > MOST:
        raise ValueError(f"{name}: {counts} variables; floor.c has room for {MOST} of a type")
    return root.find("CoSimulation").attrib["modelIdentifier"]  # type: ignore[union-attr]
