"""Whether the machine sticks to what it touches, and when it lets go."""

from dataclasses import dataclass
from typing import Literal

#: A hand that pulls with more than this (N) wants to leave.
PULLS = 0.3
#: From how long on it is called sticking (s): the laws that are meant to let go do so within 0.45 s.
LONG = 0.5

Word = Literal["free", "touches", "sticks"]


@dataclass
class Contact:
    """Fed with what each chunk ends with; `word` says what is seen now."""

    word: Word = "free"
    #: For how long the hand has been pulling in vain; after it let go, for how long it had (s).
    stuck: float = 0.0
    #: When it let go of a hand that pulled (s), or None.
    let_go: float | None = None

    def look(self, *, time: float, passed: float, pressed: float, pull: float) -> None:
        """`pressed` is the contact's force on the machine (N, its size), `pull` what the hand pulls away with (N),
        `passed` the time since the last look (s)."""
        if pressed <= 0.0:
            if self.word != "free" and pull > PULLS:
                self.let_go = time
            self.word = "free"
            return
        if self.word == "free":
            self.word, self.stuck = "touches", 0.0
        if pull > PULLS:
            self.stuck += passed
            self.word = "sticks" if self.stuck >= LONG else "touches"
        else:
            self.word, self.stuck = "touches", 0.0
