"""A variable of a description, as both versions of the standard know it."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from exo.validate.versions import FLOATS, FMI2, Version


@dataclass(frozen=True)
class Dimension:
    """One dimension of an array: its size, or the variable that holds it."""

    start: str | None
    reference: str | None
    where: str


@dataclass(frozen=True)
class Alias:
    """Another name of an FMI 3.0 variable. Aliases of FMI 2.0 are variables of their own."""

    own: Mapping[str, str]
    where: str

    @property
    def name(self) -> str:
        """The name, empty if missing."""
        return self.own.get("name", "")


@dataclass(frozen=True)
class Variable:
    """A variable, with what its declared type gives."""

    version: Version
    #: 1-based position, as ModelStructure of FMI 2.0 counts.
    index: int
    #: Own attributes, those of the kind's element left out in FMI 2.0.
    own: Mapping[str, str]
    #: One of the version's kinds; empty when there is none of them.
    kind: str
    #: Attributes of the kind over those of the declared type.
    type: Mapping[str, str]
    where: str
    #: Of FMI 3.0 only.
    dimensions: tuple[Dimension, ...] = ()
    aliases: tuple[Alias, ...] = ()
    #: Values of `Start` elements.
    texts: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name, empty if missing."""
        return self.own.get("name", "")

    @property
    def named(self) -> "tuple[Variable | Alias, ...]":
        """Itself and its aliases."""
        return (self, *self.aliases)

    @property
    def causality(self) -> str:
        """The causality, by default local."""
        return self.own.get("causality", "local")

    @property
    def variability(self) -> str:
        """The variability, given or the default of its version."""
        if "variability" in self.own:
            return self.own["variability"]
        if self.version is FMI2:
            return "continuous"
        if self.causality.endswith("arameter"):
            return "fixed"
        return "continuous" if self.kind in FLOATS else "discrete"

    @property
    def initial(self) -> str:
        """How the value is initialised: given, or the default of causality and variability; empty for none."""
        if "initial" in self.own:
            return self.own["initial"]
        if self.causality == "independent" or (self.causality == "input" and self.version is FMI2):
            return ""
        exact = self.causality in ("parameter", "structuralParameter", "input") or self.variability == "constant"
        return "exact" if exact else "calculated"

    @property
    def has_start(self) -> bool:
        """Whether the importer knows the value before it asks the FMU."""
        return self.kind != "Clock" and (self.causality == "input" or self.initial == "exact")

    @cached_property
    def starts(self) -> tuple[str, ...] | None:
        """Start values, one for all elements or one each; None without any."""
        if self.texts:
            return self.texts
        start = self.type.get("start")
        if start is None:
            return None
        return (start,) if self.version is FMI2 else tuple(start.split())

    @cached_property
    def reference(self) -> int | None:
        """The value reference; None when it is no unsigned 32-bit number."""
        found = integers(self.own.get("valueReference"))
        return found[0] if found and len(found) == 1 and 0 <= found[0] < 1 << 32 else None

    @property
    def clocked(self) -> bool:
        """Whether it belongs to clocks."""
        return "clocks" in self.own


def number(text: str | None) -> float | None:
    """The number that an attribute holds, None without one."""
    try:
        return None if text is None else float(text)
    except ValueError:
        return None


def integers(text: str | None) -> list[int] | None:
    """The list that an attribute holds; None without one, or when it is not a list of integers."""
    try:
        return None if text is None else [int(part) for part in text.split()]
    except ValueError:
        return None
