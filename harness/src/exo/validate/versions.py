"""The words of FMI 2.0 and of FMI 3.0 for the same things: attributes, elements, functions, kinds of variables."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from lxml import etree

#: Kinds of variables that are floating-point numbers, in both versions.
FLOATS = frozenset(("Real", "Float32", "Float64"))
#: Bits of the kinds that are integers, and whether these have a sign. An Enumeration has those of its version.
INTEGERS: Mapping[str, tuple[int, bool]] = MappingProxyType(
    {"Integer": (32, True)} | {f"{sign}Int{bits}": (bits, not sign) for bits in (8, 16, 32, 64) for sign in ("", "U")}
)
#: Kinds whose start values are elements of their own in FMI 3.0.
TEXTS = frozenset(("String", "Binary"))


@dataclass(frozen=True)
class Version:
    """What one version of the standard calls things."""

    name: str
    #: Beginning of all functions' names.
    prefix: str
    #: The attribute that fmi?Instantiate compares.
    token: str
    #: Capabilities of an interface: the FMU state.
    get_state: str
    serialize: str
    #: Interfaces that are judged, the one that is run first.
    interfaces: tuple[str, ...]
    #: Kinds of variables.
    kinds: tuple[str, ...]
    #: Bits of an Enumeration.
    enumeration_bits: int
    #: Sections of ModelStructure, by FMI 2.0's names, with the path to their unknowns.
    sections: Mapping[str, str]
    #: What an unknown names its variable by.
    unknown: str
    #: Functions of the C interface by the interface that alone has them; empty for those of all.
    functions: Mapping[str, frozenset[str]] = field(repr=False)

    def needed(self, interfaces: Collection[str]) -> frozenset[str]:
        """The functions that a library with these interfaces exports."""
        return frozenset().union(*(self.functions.get(name, frozenset()) for name in ("", *interfaces)))

    def bits(self, kind: str) -> tuple[int, bool] | None:
        """Size and sign of a kind that is an integer, None of any other."""
        return (self.enumeration_bits, True) if kind == "Enumeration" else INTEGERS.get(kind)

    def type_elements(self, element: etree._Element) -> list[tuple[str, etree._Element]]:
        """Kinds and elements with the attributes of a type definition."""
        if self is FMI2:
            return [(str(child.tag), child) for child in element if child.tag in self.kinds]
        return [(str(element.tag).removesuffix("Type"), element)]


COMMON = """GetVersion SetDebugLogging FreeInstance Terminate Reset EnterInitializationMode ExitInitializationMode
    GetDirectionalDerivative"""
#: Functions of one interface only. In FMI 2.0 fmi2Instantiate serves both.
ONLY_2 = {
    "ModelExchange": """EnterEventMode NewDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep SetTime
        SetContinuousStates GetDerivatives GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates""",
    "CoSimulation": """SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep GetStatus GetRealStatus
        GetIntegerStatus GetBooleanStatus GetStringStatus""",
}
COMMON_2 = """GetTypesPlatform Instantiate SetupExperiment GetReal GetInteger GetBoolean GetString SetReal SetInteger
    SetBoolean SetString GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate
    DeSerializeFMUstate"""
ONLY_3 = {
    "ModelExchange": """InstantiateModelExchange EnterContinuousTimeMode CompletedIntegratorStep SetTime
        SetContinuousStates GetContinuousStateDerivatives GetEventIndicators GetContinuousStates
        GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates""",
    "CoSimulation": "InstantiateCoSimulation EnterStepMode GetOutputDerivatives DoStep",
    "ScheduledExecution": "InstantiateScheduledExecution ActivateModelPartition",
}
#: Kinds of FMI 3.0, as elements and in the names of its functions for values.
KINDS_3 = (
    *("Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"),
    *("Boolean", "String", "Binary", "Enumeration", "Clock"),
)
VALUES_3 = " ".join(f"Get{kind} Set{kind}" for kind in KINDS_3 if kind != "Enumeration")
COMMON_3 = f"""{VALUES_3} EnterEventMode GetNumberOfVariableDependencies GetVariableDependencies GetFMUState SetFMUState
    FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState GetAdjointDerivative
    EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction
    SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction EvaluateDiscreteStates
    UpdateDiscreteStates"""


def _functions(prefix: str, common: str, only: Mapping[str, str]) -> dict[str, frozenset[str]]:
    named = {"": f"{COMMON} {common}"} | dict(only)
    return {interface: frozenset(f"{prefix}{name}" for name in names.split()) for interface, names in named.items()}


FMI2 = Version(
    name="2.0",
    prefix="fmi2",
    token="guid",
    get_state="canGetAndSetFMUstate",
    serialize="canSerializeFMUstate",
    interfaces=("CoSimulation",),
    kinds=("Real", "Integer", "Boolean", "String", "Enumeration"),
    enumeration_bits=32,
    sections={name: f"ModelStructure/{name}/Unknown" for name in ("Outputs", "Derivatives", "InitialUnknowns")},
    unknown="index",
    functions=_functions("fmi2", COMMON_2, ONLY_2),
)
FMI3 = Version(
    name="3.0",
    prefix="fmi3",
    token="instantiationToken",
    get_state="canGetAndSetFMUState",
    serialize="canSerializeFMUState",
    interfaces=("CoSimulation", "ScheduledExecution"),
    kinds=KINDS_3,
    enumeration_bits=64,
    sections={
        "Outputs": "ModelStructure/Output",
        "Derivatives": "ModelStructure/ContinuousStateDerivative",
        "InitialUnknowns": "ModelStructure/InitialUnknown",
        "ClockedStates": "ModelStructure/ClockedState",
        "EventIndicators": "ModelStructure/EventIndicator",
    },
    unknown="valueReference",
    functions=_functions("fmi3", COMMON_3, ONLY_3),
)
VERSIONS = {version.name: version for version in (FMI2, FMI3)}
