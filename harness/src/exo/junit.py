"""JUnit files: one of each scenario in its folder, and one of all scenarios of a place, made from those."""

import math
from pathlib import Path
from xml.etree import ElementTree as ET

from exo.experiment import Experiment
from exo.folder import locked, write_file

NAME = "junit.xml"


def suite(experiment: Experiment) -> ET.Element:
    """One test case a verdict; information is no test."""
    judged = [result for result in experiment.results if result.verdict != "info"]
    found = ET.Element(
        "testsuite",
        name=experiment.scenario.id,
        tests=str(len(judged)),
        failures=str(sum(result.verdict == "fail" for result in judged)),
        errors="0",
        skipped="0",
        time=f"{sum(run.wall_time for run in experiment.recordings.values()):.3f}",
    )
    for result in judged:
        case = ET.SubElement(found, "testcase", classname=experiment.scenario.id, name=result.id, time="0")
        if result.verdict == "fail":
            value = f"{result.value:.6g}" if math.isfinite(result.value) else "undefined"
            text = f"{result.title}: {value} {result.unit}, expected {result.expectation()} ({result.source})"
            ET.SubElement(case, "failure", message=text)
    return found


def text(suites: list[ET.Element]) -> bytes:
    """A whole file."""
    root = ET.Element("testsuites", name="exo")
    root.extend(suites)
    ET.indent(root)
    return bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True))


def combine(out: Path) -> Path:
    """`<out>/junit.xml` from the scenarios' own files, those of earlier runs among them."""
    path = out / NAME
    with locked(out):
        suites = []
        for file in sorted(out.glob(f"*/{NAME}")):
            if file.parent.name.startswith("."):
                continue  # a folder that is being written
            try:
                suites += ET.parse(file).getroot().findall("testsuite")
            except ET.ParseError:
                continue  # not one that exo has written
        write_file(path, text(suites))
    return path
