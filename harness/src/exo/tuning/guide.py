"""The numbers of the gain guide."""

from dataclasses import dataclass, replace

from exo.errors import ExoError
from exo.theory import Hand
from exo.tuning import region
from exo.tuning.friction import Friction
from exo.tuning.machine import LEAST, Gains, Machine, check
from exo.tuning.quantization import Quantization, quantization
from exo.tuning.region import Interval, Swing
from exo.tuning.sliding import Sliding, sliding

#: K T/M_min and M_n/M_min that the controllers warn of (fmu/admittance/src/advice.rs).
KT_OVER_M_MAX = 0.25
MN_OVER_M_MIN = 0.1
#: The recommended gains hold K and the hand's stiffness this many times over.
MARGIN = 2.0


@dataclass(frozen=True, kw_only=True)
class AtMass:
    """The loop at one mass M (kg) with the gains that are judged.

    `K_free` (N·s/m): where K is stable without a hand; `K_held`: with it. `k_h_limit` in N/m, `delay_margin` and
    `slowest` (time constant) in s, `error` in m/N, `growth` in 1/s.
    """

    M: float
    stable: bool
    growth: float
    K_free: Interval | None
    K_held: Interval | None
    k_h_limit: float
    delay_margin: float | None
    slowest: float
    swing: Swing | None
    error: float

    def sampled_share(self, T: float) -> float:
        """Largest stable K T/M without a hand; 0 if there is none."""
        return self.K_free.high * T / self.M if self.K_free else 0.0


@dataclass(frozen=True, kw_only=True)
class Guide:
    """Everything that `exo tune` says. Masses and nominal in kg, K and D_n in N·s/m.

    `quantization` is None for an ideal encoder. `sliding` is what dry friction does at the lightest and at the heaviest
    mass, empty without friction.
    """

    machine: Machine
    gains: Gains
    frequency: float
    masses: list[AtMass]
    K_recommended: float | None
    M_n_smallest: float | None
    D_n_smallest: float | None
    gain_warning: int
    friction: Friction | None
    quantization: Quantization | None
    sliding: list[Sliding]

    @property
    def worst_sliding(self) -> Sliding | None:
        """That of the mass at which motion is smooth from the highest speed on."""
        return max(self.sliding, key=lambda at: (at.smooth_above, at.slips_below), default=None)

    @property
    def stable(self) -> bool:
        """Whether the gains are stable at every mass."""
        return all(at.stable for at in self.masses)

    @property
    def stable_gains(self) -> Interval | None:
        """The K (N·s/m) that are stable at every mass, with the hand; None if there is none."""
        held = [at.K_held for at in self.masses if at.K_held]
        low, high = max((x.low for x in held), default=0.0), min((x.high for x in held), default=0.0)
        return Interval(low, high) if len(held) == len(self.masses) and low < high else None

    @property
    def gain_margin(self) -> float:
        """By what factor K may rise at every mass, with the hand; below 1 it must fall."""
        return min((at.K_held.high if at.K_held else 0.0) for at in self.masses) / self.gains.K

    @property
    def lowering_margin(self) -> float:
        """By what factor K may fall at every mass, with the hand; infinite: to 0, below 1: it must rise."""
        lowest = max((at.K_held.low if at.K_held else float("inf")) for at in self.masses)
        return self.gains.K / lowest if lowest else float("inf")

    @property
    def unstable(self) -> list[AtMass]:
        """Where the gains are not stable, from the lightest mass to the heaviest."""
        return [at for at in self.masses if not at.stable]

    @property
    def k_h_limit(self) -> float:
        """Hand stiffness (N/m) that every mass holds."""
        return min(at.k_h_limit for at in self.masses)


def recommended_gain(*, machine: Machine, gains: Gains) -> float | None:
    """The largest K (N·s/m) within K T/M_min = 0.25 that is `MARGIN` below the limit at every mass, with and without
    the hand; None if the hand leaves no K. The error falls as 1/K, down to what sampling leaves of it."""
    highest = KT_OVER_M_MAX * machine.M_min / machine.T
    lowest = 0.0
    for M in machine.masses:
        for hand in (Hand(), machine.hand):
            interval = region.gain_interval(machine=machine, gains=gains, M=M, hand=hand)
            if interval is None:
                return None
            highest, lowest = min(highest, interval.high / MARGIN), max(lowest, interval.low)
    return highest if highest > lowest else None


def warning(*, machine: Machine, gains: Gains) -> int:
    """`gain_warning` of the controllers: 1 K T/M_min above 0.25, 2 M_n below M_min/10, 3 both."""
    stiff = KT_OVER_M_MAX * machine.M_min < gains.K * machine.T
    return int(stiff) + 2 * int(gains.M_n < MN_OVER_M_MIN * machine.M_min)


def at_mass(*, machine: Machine, gains: Gains, M: float, frequency: float) -> AtMass:
    """All numbers at one mass (kg)."""
    stable = region.is_stable(machine=machine, gains=gains, M=M)
    slowest, swing = region.modes(machine=machine, gains=gains, M=M)
    return AtMass(
        M=M,
        stable=stable,
        growth=region.growth(machine=machine, gains=gains, M=M),
        K_free=region.gain_interval(machine=machine, gains=gains, M=M, hand=Hand()),
        K_held=region.gain_interval(machine=machine, gains=gains, M=M),
        k_h_limit=region.hand_limit(machine=machine, gains=gains, M=M),
        delay_margin=region.delay_margin(machine=machine, gains=gains, M=M) if stable else None,
        slowest=slowest,
        swing=swing,
        error=region.error_per_newton(machine=machine, gains=gains, M=M, frequency=frequency),
    )


def guide(
    *,
    machine: Machine,
    gains: Gains,
    frequency: float,
    friction: Friction | None = None,
    speed: float | None = None,
) -> Guide:
    """Judges the gains at every mass, and looks for better ones.

    M_n_smallest and D_n_smallest: each alone, the other gains as given, so that the loop holds `MARGIN` times the
    hand's stiffness at every mass; 0 if nothing bounds it, None if it alone does not do. `frequency` in Hz, at
    most that of a swing from tick to tick. `speed` in m/s is one that is asked about; it needs a friction.
    """
    check("frequency", frequency, least=LEAST, most=0.5 / machine.T)
    if speed is not None:
        check("speed", speed, least=LEAST)
        if friction is None:
            raise ExoError(f"speed = {speed:g}: expected dry friction beside it: F_c, or a scenario that has it")

    def holds(changed: Gains) -> bool:
        return region.stable_at_all(machine=machine, gains=changed, k_h_factor=MARGIN)

    slides = []
    if friction is not None:
        slides = [
            sliding(machine=machine, gains=gains, friction=friction, M=M, speed=speed)
            for M in sorted({machine.M_min, machine.M_max})
        ]
    return Guide(
        machine=machine,
        gains=gains,
        frequency=frequency,
        masses=[at_mass(machine=machine, gains=gains, M=M, frequency=frequency) for M in machine.masses],
        K_recommended=recommended_gain(machine=machine, gains=gains),
        M_n_smallest=region.smallest(
            stable=lambda M_n: holds(replace(gains, M_n=M_n)), low=1e-2 * machine.M_min, high=2.0 * machine.M_max
        ),
        D_n_smallest=region.smallest(
            stable=lambda D_n: holds(replace(gains, D_n=D_n)), low=1e-2, high=1e3 * machine.M_max
        ),
        gain_warning=warning(machine=machine, gains=gains),
        friction=friction,
        quantization=quantization(machine=machine, gains=gains, F_c=friction.F_c if friction else 0.0),
        sliding=slides,
    )
