"""Writes what the archives carry: `<folder>/<FMU>/`, with the paths that the files have in the archive.

| file, below `extra/org.fmi-standard.fmi-ls-ref/` | what |
|---|---|
| `fmi-ls-manifest.xml` | the manifest: every other file with type, role and a sentence |
| `smoke-tests.exp` | the experiments, in the format MA-HS-Experiments |
| `<experiment>-in.csv`, `…-ref.csv` | inputs at the beginning of each step; outputs at communication points |
| `parameters/<set>.ssv` | SSP parameter sets: of the paper's cases, the presets, the experiments |
| `requirements.md` | what the paper asks for and the scenarios are judged by |

`documentation/fmi-ls-ref.html` tells it to a reader. The same bytes on any machine and day.
"""

import csv
import io
from collections.abc import Mapping
from pathlib import Path

import jinja2
import numpy as np
from lxml import etree
from numpy.typing import NDArray

from exo.fmu import Archive
from exo.folder import write_file
from exo.references import recipes, requirements, sets
from exo.references.names import DESCRIPTION, EXPERIMENTS_TYPE, FMI_LS, FOLDER, MANIFEST, NAME, SSV_TYPE, VERSION
from exo.references.record import RESULT, STIMULUS, Columns, Experiment, coupled, record

#: Of each column's largest magnitude. A result has three digits more; another platform gives the same bits; an
#: importer that sums its time up, in place of counting steps, is off by less than a thousandth of it.
TOLERANCE = 1e-6
EXP = "smoke-tests.exp"
REQUIREMENTS = "requirements.md"
DOCUMENT = "documentation/fmi-ls-ref.html"


def needed() -> list[str]:
    """Names of the archives from which `contents` records."""
    return sorted({file for run in recipes.load().runs.values() for file in coupled(run).components.values()})


def contents(archives: Mapping[str, Archive]) -> dict[str, bytes]:
    """All files of all FMUs by path, `<FMU>/<path in the archive>`; `archives` are opened FMUs by archive name."""
    data = recipes.load()
    by_archive: dict[str, list[Experiment]] = {}
    for name, run in data.runs.items():
        for experiment in record(name, run, archives):
            by_archive.setdefault(experiment.archive, []).append(experiment)
    files: dict[str, bytes] = {}
    for file, experiments in sorted(by_archive.items()):
        name = file.removesuffix(".fmu")
        found = sets.of(file, experiments)
        inside = {
            **{values.source: values.content(archives[file]) for values in found},
            REQUIREMENTS: requirements.text(name, data.shows, experiments).encode(),
            EXP: _experiments(name, experiments, found),
            MANIFEST: _manifest(experiments, found),
        }
        for one in experiments:
            if one.stimuli:
                inside[_stimuli(one)] = _csv(one.stimuli_time, one.stimuli, STIMULUS)
            inside[_results(one)] = _csv(one.time, one.results, RESULT)
        files |= {f"{name}/{FOLDER}/{path}": data for path, data in sorted(inside.items())}
        files[f"{name}/{DOCUMENT}"] = _document(name, experiments, found).encode()
    return files


def differences(files: Mapping[str, bytes], folder: Path) -> list[str]:
    """Paths of `folder` that are not what they are now, or should not be there."""
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    return sorted(there ^ set(files)) + [
        path for path, data in files.items() if path in there and (folder / path).read_bytes() != data
    ]


def write(files: Mapping[str, bytes], folder: Path) -> list[str]:
    """Makes `folder` hold the files and nothing else; returns what had to change."""
    changed = differences(files, folder)
    for path in changed:
        if path in files:
            write_file(folder / path, files[path])
        else:
            (folder / path).unlink()
    return changed


def _stimuli(experiment: Experiment) -> str:
    return f"{experiment.name}-in.csv"


def _results(experiment: Experiment) -> str:
    return f"{experiment.name}-ref.csv"


def _csv(time: NDArray[np.float64], columns: Columns, digits: str) -> bytes:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["time", *columns])
    for row in zip(time, *columns.values(), strict=True):
        # A time has all its digits, so that it is the importer's k·T.
        writer.writerow([repr(float(row[0])), *(format(float(value), digits) for value in row[1:])])
    return text.getvalue().encode()


def _experiments(name: str, experiments: list[Experiment], found: list[sets.ParameterSet]) -> bytes:
    root = etree.Element(
        "Experiments", name=name, description="Short runs of the paper's experiments, each of this FMU alone"
    )
    for one in experiments:
        element = etree.SubElement(root, "Experiment", name=one.name, description=one.title, tolerance=repr(TOLERANCE))
        etree.SubElement(
            element,
            "TransientSimulation",
            startTime="0.0",
            stopTime=repr(one.duration),
            stepSize=repr(one.step),
        )
        if (parameters := sets.for_experiment(found, one)) is not None:
            etree.SubElement(element, "Parameters", source=parameters.source)
        if one.stimuli:
            etree.SubElement(element, "Stimuli", source=_stimuli(one))
        etree.SubElement(element, "References", source=_results(one))
    return _xml(root)


def _manifest(experiments: list[Experiment], found: list[sets.ParameterSet]) -> bytes:
    root = etree.Element(
        "fmiReferences",
        nsmap={"fmi-ls": FMI_LS},
        attrib={
            f"{{{FMI_LS}}}fmi-ls-name": NAME,
            f"{{{FMI_LS}}}fmi-ls-version": VERSION,
            f"{{{FMI_LS}}}fmi-ls-description": DESCRIPTION,
        },
    )

    def related(kind: str, source: str, role: str, description: str, labels: list[str]) -> None:
        element = etree.SubElement(root, "Related", type=kind, source=source, role=role, description=description)
        for label in labels:
            etree.SubElement(element, "Label", name=label)

    tests = "Short runs of the paper's experiments, with inputs and reference results"
    related(EXPERIMENTS_TYPE, EXP, "experiment/smoke-test", tests, [])
    related("text/markdown", REQUIREMENTS, "requirement", "What the paper asks for and the scenarios are judged by", [])
    for one in experiments:
        labels = [f"scenario:{one.scenario}"]
        if one.stimuli:
            related("text/csv", _stimuli(one), "other", f"Inputs of the experiment {one.name}", labels)
        related("text/csv", _results(one), "result", f"Outputs of the experiment {one.name}", labels)
    for values in found:
        labels = [f"scenario:{scenario}" for scenario in values.scenarios]
        related(SSV_TYPE, values.source, "parameter", "; ".join(values.titles), labels)
    related("text/html", f"../../{DOCUMENT}", "document", "What these files are and how they are used", [])
    return _xml(root)


def _document(name: str, experiments: list[Experiment], found: list[sets.ParameterSet]) -> str:
    loader = jinja2.PackageLoader("exo", "references")
    environment = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, undefined=jinja2.StrictUndefined)
    return (
        environment.get_template("document.html.jinja").render(
            name=name,
            folder=FOLDER,
            version=VERSION,
            tolerance=f"{TOLERANCE:g}",
            experiments=experiments,
            sets=found,
            requirements=REQUIREMENTS,
        )
        + "\n"
    )


def _xml(root: etree._Element) -> bytes:
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True))
