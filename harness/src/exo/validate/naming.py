"""Names of variables under variableNamingConvention="structured": the grammar of section 2.2.9 as one expression.

fmpy has the grammar too, as an Earley parser that takes a hundredth of a second for a name. This one is linear: no two
alternatives begin with the same character.
"""

import re
from collections.abc import Iterator

from exo.validate.description import Description
from exo.validate.rule import Finding, error

STRUCTURED = error("variable-structured", "names follow the grammar of variableNamingConvention, if it is structured")

_QUOTED = r"'(?:[-A-Za-z0-9_!#$%&()*+,./:;<>=?@\[\]^{}|~ ]|\\['\"?\\abfnrtv])+'"
_PART = rf"(?:[A-Za-z_][A-Za-z0-9_]*|{_QUOTED})(?:\[[0-9]+(?:,[0-9]+)*\])?"
_IDENTIFIER = rf"{_PART}(?:\.{_PART})*"
NAME = re.compile(rf"der\({_IDENTIFIER}(?:,[0-9]+)?\)|{_IDENTIFIER}")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    if description.root.get("variableNamingConvention") != "structured":
        return
    for variable in description.variables:
        for named in variable.named:
            if not NAME.fullmatch(named.name):
                yield STRUCTURED.at(named.where, repr(named.name), "a name like body.joint[2].'x y' or der(body.x,2)")
