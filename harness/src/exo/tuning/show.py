"""The gain guide as a sentence, as tables and as JSON."""

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.table import Table
from rich.text import Text

from exo.folder import replaced_file, write_file
from exo.tuning.guide import KT_OVER_M_MAX, MARGIN, MN_OVER_M_MIN, AtMass, Guide
from exo.tuning.region import Interval

#: What the columns of `by_mass` are.
LEGEND = """\
K T/M        largest stable one without a hand
K from, to   stable with the hand, N·s/m
k_h to       largest stable stiffness of the hand, N/m
delay        how much later τ_a may come, ms
slowest      time constant, s
damping      of the least damped oscillation, at `swing` Hz
e            swing of e for 1 N at {frequency:g} Hz without a hand, mm"""


def number(value: float | None) -> str:
    """Three figures; a dash for what does not exist."""
    if value is None:
        return "–"
    if math.isinf(value):
        return "∞" if value > 0.0 else "−∞"
    return f"{float(f'{value:.3g}'):.12g}"


def verdict(guide: Guide) -> str:
    """Whether the gains are stable, and how far K is from where they are not."""
    K = f"K = {number(guide.gains.K)} N·s/m"
    if guide.stable:
        masses = " to ".join(dict.fromkeys(number(M) for M in (guide.machine.M_min, guide.machine.M_max)))
        fall = "to 0" if math.isinf(guide.lowering_margin) else f"by a factor of {number(guide.lowering_margin)}"
        rise = f"by a factor of {number(guide.gain_margin)}"
        return f"stable: nothing grows at M = {masses} kg. {K} may rise {rise} and fall {fall}."
    worst = max(guide.unstable, key=lambda at: at.growth)
    interval = guide.stable_gains
    held = f"stable from {number(interval.low)} to {number(interval.high)} N·s/m" if interval else "no K is stable"
    return (
        f"unstable: something grows by {number(worst.growth)} 1/s at M = {number(worst.M)} kg. "
        f"{K}; {held} at every mass with this hand."
    )


def warnings(guide: Guide) -> list[str]:
    """What encoder and dry friction do, a sentence each, with what would mend it."""
    found = []
    count, sliding = guide.quantization, guide.worst_sliding
    if count and not count.is_swallowed:
        mends = [
            text
            for value, text in (
                (count.resolution_needed, f"a count of {number(count.resolution_needed)} m"),
                (count.K_needed, f"K = {number(count.K_needed)} N·s/m"),
                (count.cutoff_needed, f"a low pass of {number(count.cutoff_needed)} Hz on the velocity"),
            )
            if value is not None
        ]
        has = f"dry friction takes {number(guide.friction.F_c)} N" if guide.friction else "there is no dry friction"
        found.append(
            f"encoder: readings within half a count make up to {number(count.force)} N, and {has}: "
            "a limit cycle may be." + (f" Each alone mends it: {', '.join(mends)}." if mends else "")
        )
    if sliding and sliding.slips:
        spans = " and ".join(between(speeds) for speeds in sliding.slips)
        mend = (
            "no K alone mends it" if sliding.K_smooth is None else f"K from {number(sliding.K_smooth)} N·s/m mends it"
        )
        found.append(f"stick-slip: steady motion is unstable {spans} at M = {number(sliding.M)} kg; {mend}.")
    if sliding and sliding.smooth_above > sliding.slips_below:
        span = between(Interval(0.0, sliding.smooth_above))
        found.append(f"stick-slip: {span} a swing can last once a jolt or rest has begun it.")
    return found


def between(speeds: Interval) -> str:
    """A range of speeds in words, in mm/s."""
    if math.isinf(speeds.high):
        return f"above {number(1e3 * speeds.low)} mm/s" if speeds.low else "at every speed"
    if not speeds.low:
        return f"below {number(1e3 * speeds.high)} mm/s"
    return f"from {number(1e3 * speeds.low)} to {number(1e3 * speeds.high)} mm/s"


def by_mass(guide: Guide) -> Table:
    """One row a mass."""
    table = Table(box=None, padding=(0, 1, 0, 0))
    for name in ("M [kg]", "stable", "K T/M", "K from", "K to", "k_h to", "delay", "slowest", "damping", "swing", "e"):
        table.add_column(Text(name), no_wrap=True)
    for at in guide.masses:
        table.add_row(
            number(at.M),
            "yes" if at.stable else "no",
            number(at.sampled_share(guide.machine.T)),
            number(at.K_held.low if at.K_held else None),
            number(at.K_held.high if at.K_held else None),
            number(at.k_h_limit),
            number(None if at.delay_margin is None else 1e3 * at.delay_margin),
            number(at.slowest),
            number(at.swing.damping if at.swing else None),
            number(at.swing.frequency if at.swing else None),
            number(1e3 * at.error),
        )
    return table


def summary(guide: Guide) -> Table:
    """What follows for the gains."""
    machine, gains = guide.machine, guide.gains
    share = gains.K * machine.T / machine.M_min
    coasting = gains.M_n / gains.D_n if gains.D_n else math.inf
    table = Table(box=None, show_header=False, padding=(0, 1))
    for row in (
        ("K", number(gains.K), f"N·s/m; K T/M_min = {number(share)}, advised ≤ {KT_OVER_M_MAX}"),
        ("recommended K", number(guide.K_recommended), f"N·s/m; {MARGIN:g} below the limit at every mass"),
        ("K may rise by", number(guide.gain_margin), "with the hand"),
        ("K may fall by", number(guide.lowering_margin), "with the hand"),
        ("k_h limit", number(guide.k_h_limit), f"N/m at the worst mass; the hand has {machine.k_h:g}"),
        ("smallest M_n", number(guide.M_n_smallest), f"kg for {MARGIN:g} k_h; it is {gains.M_n:g}"),
        ("smallest D_n", number(guide.D_n_smallest), f"N·s/m for {MARGIN:g} k_h; it is {gains.D_n:g}"),
        ("M_n/M_min", number(gains.M_n / machine.M_min), f"advised ≥ {MN_OVER_M_MIN}"),
        ("M_n/D_n", number(coasting), "s, how long the nominal coasts"),
        ("1/K_P", number(1.0 / gains.K_P), "s, how fast e decays"),
        ("gain_warning", str(guide.gain_warning), "0 none, 1 K T/M_min, 2 M_n/M_min, 3 both"),
        *encoder(guide),
        *friction(guide),
    ):
        table.add_row(*row)
    return table


def encoder(guide: Guide) -> list[tuple[str, str, str]]:
    """Rows of the summary on the encoder."""
    count = guide.quantization
    if count is None:
        return []
    share = f"{number(count.share)} of dry friction, advised ≤ 1" if guide.friction else "no dry friction takes it"
    return [
        ("velocity of a count", number(count.velocity), f"m/s, for a count of {number(count.resolution)} m"),
        ("force of a count", number(count.step), "N"),
        ("force of the readings", number(count.force), f"N at most; {share}"),
    ]


def friction(guide: Guide) -> list[tuple[str, str, str]]:
    """Rows of the summary on dry friction."""
    at = guide.worst_sliding
    if at is None:
        return []
    rows = [
        (
            "slips",
            " and ".join(between(speeds) for speeds in at.slips) or "never",
            "by itself, where steady motion grows",
        ),
        (
            "smooth above",
            number(1e3 * at.smooth_above),
            "mm/s, where no swing lasts; below, a jolt or rest may begin one",
        ),
        ("least slope", number(at.least_slope), f"N·s/m of friction; the loop holds {number(at.least_held)}"),
        ("smooth K", number(at.K_smooth), "N·s/m, from which on no speed slips by itself"),
    ]
    if at.speed is not None:
        rows.append((f"at {number(1e3 * at.speed)} mm/s", str(at.verdict), f"M = {number(at.M)} kg"))
    return rows


def document(guide: Guide) -> dict[str, Any]:
    """Everything as JSON data; what is infinite is null."""

    def finite(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: finite(x) for key, x in value.items()}
        if isinstance(value, list):
            return [finite(x) for x in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    def row(at: AtMass) -> dict[str, Any]:
        return {**asdict(at), "KT_over_M_limit": at.sampled_share(guide.machine.T)}

    whole = {
        **asdict(guide),
        "masses": [row(at) for at in guide.masses],
        "stable": guide.stable,
        "stable_gains": asdict(guide.stable_gains) if guide.stable_gains else None,
        "gain_margin": guide.gain_margin,
        "lowering_margin": guide.lowering_margin,
        "k_h_limit": guide.k_h_limit,
        "warnings": warnings(guide),
    }
    converted: dict[str, Any] = finite(whole)
    return converted


def write(*, guide: Guide, out: Path) -> list[Path]:
    """Writes tune.json and tune.png. ExoError, if one cannot be written."""
    text, picture = out / "tune.json", out / "tune.png"
    write_file(text, (json.dumps(document(guide), indent=1, ensure_ascii=False) + "\n").encode())
    from exo.tuning import chart  # noqa: PLC0415  matplotlib takes its time

    with replaced_file(picture) as fresh:
        chart.draw(guide=guide, path=fresh)
    return [text, picture]
