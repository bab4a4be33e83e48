"""FMUs with variables of every type, as fmpy and `exo validate` meet them.

`feedthrough` has every type of FMI 3.0, `narrow` the small ones that FMI 2.0 has, too. Both are the exporter's examples
(modelDescription/export/examples).
"""

import ctypes
import json
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import POINTER, c_size_t, c_ubyte
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

from cargo_fmu import ROOT, cargo_fmu
from exo.validate import binaries

from commands import exo

EVERY, NARROW_3, NARROW_2 = "test/fmi3/feedthrough.fmu", "test/fmi3/narrow.fmu", "test/narrow.fmu"

#: Values of each type from one end to the other, for the input of this name.
VALUES: dict[str, list[Any]] = {
    "float32": [
        float(np.float32(value)) for value in (-3.4028234663852886e38, 0.1, 1.1754944e-38, 3.4028234663852886e38)
    ],
    "float64": [-1.7976931348623157e308, 0.1, 2.2250738585072014e-308, 1.7976931348623157e308],
    "int8": [-128, -1, 0, 127],
    "uint8": [0, 1, 128, 255],
    "int16": [-32768, -1, 256, 32767],
    "uint16": [0, 255, 32768, 65535],
    "int32": [-(2**31), -1, 65536, 2**31 - 1],
    "uint32": [0, 65535, 2**31, 2**32 - 1],
    "int64": [-(2**63), -1, 2**53 + 1, 2**63 - 1],
    "uint64": [0, 2**53 + 1, 2**63, 2**64 - 1],
    "boolean": [False, True, False, True],
    "option": [1, 2, 2, 1],
    "string": ["", "ü", "a\nb", "<&>"],
    "binary": [b"", b"\x00\xff", b"0123456789abcdef", b"\n"],
}


def kind(variable: Any) -> str:
    """What its functions are called."""
    return "Int64" if variable.type == "Enumeration" else str(variable.type)


class Fed:
    """An instance of FMI 3.0, called by the names of its variables, one value each."""

    def __init__(self, slave: FMU3Slave, variables: dict[str, Any]) -> None:
        self.slave = slave
        self.variables = variables

    def set(self, name: str, value: Any) -> None:
        variable = self.variables[name]
        reference = [variable.valueReference]
        if variable.type == "Binary":
            references, sizes = (ctypes.c_uint * 1)(*reference), (c_size_t * 1)(len(value))
            pointers = (POINTER(c_ubyte) * 1)((c_ubyte * max(1, len(value)))(*value))
            args = (references, c_size_t(1), sizes, pointers, c_size_t(1))
            if self.slave.dll.fmi3SetBinary(self.slave.component, *args) != 0:
                raise FMICallException(function="fmi3SetBinary", status=3)
            return
        getattr(self.slave, f"set{kind(variable)}")(reference, [value])

    def get(self, name: str) -> Any:
        variable = self.variables[name]
        reference = [variable.valueReference]
        if variable.type == "Binary":
            references, sizes, pointers = (ctypes.c_uint * 1)(*reference), (c_size_t * 1)(), (POINTER(c_ubyte) * 1)()
            args = (references, c_size_t(1), sizes, pointers, c_size_t(1))
            assert self.slave.dll.fmi3GetBinary(self.slave.component, *args) == 0
            return ctypes.string_at(pointers[0], sizes[0])
        (value,) = getattr(self.slave, f"get{kind(variable)}")(reference)
        return value.decode() if isinstance(value, bytes) else value

    def step(self, time: float, size: float = 0.1) -> None:
        self.slave.doStep(time, size)


@contextmanager
def fed(path: Path, messages: list[str]) -> Iterator[Fed]:
    """An initialized instance; what it logs goes to `messages`."""
    description = fmpy.read_model_description(str(path))
    folder = fmpy.extract(str(path))

    def log(_: Any, __: int, ___: bytes, message: bytes) -> None:
        messages.append(message.decode())

    slave = FMU3Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="fed",
    )
    logger = fmpy.fmi3.fmi3LogMessageCallback(log)
    slave.instantiate(loggingOn=True, logMessage=logger)
    slave.enterInitializationMode(startTime=0.0)
    slave.exitInitializationMode()
    try:
        yield Fed(slave, {variable.name: variable for variable in description.modelVariables})
    finally:
        slave.terminate()
        slave.freeInstance()


@pytest.mark.parametrize("archive", [EVERY, NARROW_3, NARROW_2])
def test_validators_find_nothing_in_variables_of_any_type(
    archive: str, fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The libraries' files are those of every example: they take most of the time.
    monkeypatch.setattr(binaries, "findings", lambda *_, **__: iter(()))
    assert validate_fmu(str(fmu_dir / archive)) == []
    found = exo("validate", "--strict", "--load", "--json", fmu_dir / archive)
    (report,) = json.loads(found.output)
    findings = [one for one in report["findings"] if one["rule"] != "run-stop-time"]
    assert findings == [], found.output


def test_each_value_of_each_type_is_fed_through_as_fmpy_gives_it(fmu_dir: Path) -> None:
    messages: list[str] = []
    with fed(fmu_dir / EVERY, messages) as instance:
        for k in range(4):
            for name, values in VALUES.items():
                instance.set(name, values[k])
            instance.step(0.1 * k)
            for name, values in VALUES.items():
                assert instance.get(name) == values[k], name
                assert instance.get(f"{name}_out") == values[k], name
    assert [one for one in messages if "refused" in one] == []


def test_fmpy_simulates_discrete_inputs_of_every_type(fmu_dir: Path) -> None:
    """It interpolates continuous ones, and knows no other inputs."""
    types: dict[str, Any] = {name: np.dtype(name) for name in VALUES if "int" in name}
    types |= {"boolean": np.bool_, "option": np.int64}
    rows = [(k * 0.5, *(VALUES[name][k] for name in types)) for k in range(4)]
    given = np.array(rows, dtype=[("time", np.float64), *types.items()])
    outputs = [f"{name}_out" for name in types]
    run = fmpy.simulate_fmu(str(fmu_dir / EVERY), input=given, output=outputs, stop_time=2.0, step_size=0.1)
    assert run["time"][-1] == pytest.approx(2.0)
    for name in types:
        column = run[f"{name}_out"].tolist()
        assert list(dict.fromkeys(column)) == list(dict.fromkeys(VALUES[name])), name


def test_a_state_of_every_type_goes_to_another_instance(fmu_dir: Path) -> None:
    with fed(fmu_dir / EVERY, []) as first, fed(fmu_dir / EVERY, []) as other:
        for name, values in VALUES.items():
            first.set(name, values[2])
        first.step(0.0)
        state = first.slave.getFMUState()
        bytes_of = first.slave.serializeFMUState(state)
        restored = other.slave.deserializeFMUState(bytes_of)
        other.slave.setFMUState(restored)
        assert {name: other.get(f"{name}_out") for name in VALUES} == {
            name: values[2] for name, values in VALUES.items()
        }
        other.step(0.1)
        first.slave.freeFMUState(state)
        other.slave.freeFMUState(restored)


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("float32", float("nan"), "fmi3SetFloat32: float32 = NaN m, expected a finite value"),
        ("binary", bytes(17), "fmi3SetBinary: binary has 17 bytes, expected at most 16"),
        ("option", 3, "fmi3SetInt64: option = 3, expected an item of Option: 1 first, 2 second"),
        ("parameter.uint16", 1, "fmi3SetUInt16: nValues = 1, expected 2, the sum of the variables' sizes"),
        ("uint8_out", 1, "fmi3SetUInt8: uint8_out is computed by the model: it cannot be set"),
    ],
)
def test_what_is_refused_is_named_with_its_value(name: str, value: Any, said: str, fmu_dir: Path) -> None:
    messages: list[str] = []
    with fed(fmu_dir / EVERY, messages) as instance:
        with pytest.raises(FMICallException):
            instance.set(name, value)
        assert said in messages
        instance.step(0.0)


def test_the_small_types_give_the_same_run_in_both_versions(fmu_dir: Path) -> None:
    """By calls: fmpy looks for the events of discrete inputs in scalars only."""
    description = fmpy.read_model_description(str(fmu_dir / NARROW_2))
    two = FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(fmu_dir / NARROW_2)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="narrow",
    )
    two.instantiate()
    two.setupExperiment(startTime=0.0)
    two.enterInitializationMode()
    two.exitInitializationMode()
    reference = {variable.name: variable.valueReference for variable in description.modelVariables}
    counts = [reference["count[1]"], reference["count[2]"]]
    with fed(fmu_dir / NARROW_3, []) as three:
        # As large as the type, so that the counters go round.
        two.setInteger([reference["increment"]], [7])
        three.set("increment", 7)
        signal = three.variables["signal"].valueReference
        seen = set()
        for k in range(40):
            values, gain = [k % 2 == 1, k % 3 == 1], 0.1 * (k - 20) / 2
            two.setBoolean([reference["signal[1]"], reference["signal[2]"]], values)
            two.setReal([reference["gain"]], [gain])
            three.slave.setBoolean([signal], values)
            three.set("gain", gain)
            two.doStep(0.01 * k, 0.01)
            three.step(0.01 * k, 0.01)
            count = three.slave.getUInt8([three.variables["count"].valueReference], nValues=2)
            assert count == two.getInteger(counts)
            for name in ("difference", "steps"):
                assert [three.get(name)] == two.getInteger([reference[name]])
            assert [three.get("mean")] == two.getReal([reference["mean"]])
            seen.add(count[1])
        assert {250, 1} <= seen, "250 and 7, modulo 256"
    two.terminate()
    two.freeInstance()


def test_the_table_of_variables_shows_every_type(fmu_dir: Path) -> None:
    table = cargo_fmu("describe", str(fmu_dir / EVERY), cwd=ROOT).stdout
    rows = {line.split()[0]: line for line in table.splitlines()[3:] if line}
    for name, shown in {
        "float32": "Float32",
        "int8": "Int8",
        "uint16": "UInt16",
        "uint64": "UInt64",
        "option": "Enumeration",
        "binary": "Binary",
    }.items():
        assert rows[name].split()[1] == shown
    assert "666F6F" in rows["binary"]
    assert "16  " in rows["binary"]
    assert rows["parameter.int64[2]"].split()[4:6] == [str(-(2**63)), str(2**63 - 1)]
    assert "image/png" in rows["parameter.binary[2]"]


def test_an_archive_of_fmi_2_is_refused_by_name_and_that_of_fmi_3_is_built(tmp_path: Path) -> None:
    example = ["--package", "fmu-export", "--example", "feedthrough"]
    run = cargo_fmu("build", "--offline", "--locked", *example, "--out", str(tmp_path), cwd=ROOT)
    assert run.returncode == 1
    said = run.stderr[run.stderr.index("error:") :]
    assert "Feedthrough has no archive of FMI 2.0: uint32 is of type UInt32, which FMI 2.0 does not have" in said
    assert 'fmi = ["3.0"]' in said
    assert [path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.fmu")] == ["fmi3/Feedthrough.fmu"]
    assert run.stdout.split() == [str(tmp_path / "fmi3" / "Feedthrough.fmu")]
