"""An FMU of many variables, in which whatever could be looked up once for each of them is there."""

from broken.parts import XML, Parts

ITEMS = 100


def large(parts: Parts, size: int) -> Parts:
    """Replaces the variables of the FMU in C by `size` others, in tens: a state, its derivative, an output, …."""
    variables, outputs, derivatives, initial = [], [], [], []
    for index in range(1, size + 1):
        causality, variability, start, extra, kind = "local", "discrete", "", "", "Real"
        match index % 10:
            case 1:
                variability = "continuous"
            case 2:
                variability, extra = "continuous", f' derivative="{index - 1}"'
                derivatives.append(f'<Unknown index="{index}" dependencies="{index - 1}"/>')
            case 3:
                causality, variability = "output", "continuous"
                outputs.append(f'<Unknown index="{index}" dependencies="{index - 2}" dependenciesKind="dependent"/>')
            case 4:
                causality, start, extra = "input", ' start="1"', ' declaredType="Angle"'
            case 5:
                causality, variability, start = "parameter", "fixed", f' start="{index % ITEMS + 1}"'
                kind, extra = "Enumeration", ' declaredType="Choice"'
        if index % 10 in (1, 2, 3):
            initial.append(f'<Unknown index="{index}" dependencies=""/>')
        unit = ' unit="rad"' if kind == "Real" else ""
        variables.append(
            f'<ScalarVariable name="plant.subsystem{index // 10}.value[{10**9 - 1 - index}].part" description="one"'
            f' valueReference="{index}" causality="{causality}" variability="{variability}">'
            f"<{kind}{unit}{extra}{start}/></ScalarVariable>"
        )
    items = "".join(f'<Item name="item{value}" value="{value}"/>' for value in range(1, ITEMS + 1))
    text = parts.entries[XML].decode()
    head, rest = text.split("<ModelVariables>")
    head = head.replace(
        "</TypeDefinitions>",
        f'<SimpleType name="Choice"><Enumeration>{items}</Enumeration></SimpleType></TypeDefinitions>',
    )
    end = rest.partition("</ModelStructure>")[2]
    parts.entries[XML] = (
        f"{head}<ModelVariables>{''.join(variables)}</ModelVariables><ModelStructure><Outputs>{''.join(outputs)}</Outputs>"
        f"<Derivatives>{''.join(derivatives)}</Derivatives>"
        f"<InitialUnknowns>{''.join(initial)}</InitialUnknowns></ModelStructure>{end}"
    ).encode()
    return parts
