"""What the laws are, in the words of the README's table, for who watches and has not read it."""

ABOUT = {
    "standard": "admittance filter alone, no reaction on the nominal; sticks to walls",
    "passive": "the paper's law: the nominal feels the unlimited coupling; creates energy once saturated",
    "passive_applied": "the nominal feels what the limits leave of the force; the spring winds up and sticks to walls",
    "passive_bounded": "the nominal feels the limited force and the spring slips at the limit; passive and bounded",
    "natural": (
        "natural admittance control (Dohring and Newman), to compare with: "
        "comparator.M in place of M_n; sticks to walls"
    ),
    "sliding_mode": "sliding-mode position control under a standard proxy (Kikuuwe), to compare with; sticks to walls",
}
