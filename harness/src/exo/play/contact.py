"""Whether the machine sticks to what it touches, and when it lets go."""

from dataclasses import dataclass
from typing import Literal

#: A hand that pulls with this (N) wants to leave; a handle that is slower than this (m/s) stays.
PULLS, RESTS = 0.3, 2e-3
#: From how long on it is called sticking (s).
LONG = 0.3

Word = Literal["free", "touches", "sticks"]


@dataclass
class Contact:
    """Fed with what each chunk ends with; `word` says what is seen now."""

    word: Word = "free"
    #: How long it has been sticking, or was stuck when it let go last (s).
    stuck: float = 0.0
    #: When it let go after sticking (s), or None.
    let_go: float | None = None

    def look(self, *, time: float, passed: float, pressed: float, pull: float, speed: float) -> None:
        """`pressed` is the contact's force on the machine (N, its size), `pull` what the hand pulls away with (N),
        `speed` that of the handle (m/s), `passed` the time since the last look (s)."""
        if pressed <= 0.0:
            if self.word == "sticks":
                self.let_go = time
            self.word = "free"
            return
        if self.word == "free":
            self.word, self.stuck = "touches", 0.0
        if pull > PULLS and abs(speed) < RESTS:
            self.stuck += passed
            if self.stuck >= LONG:
                self.word = "sticks"
        elif pull <= PULLS:
            self.word, self.stuck = "touches", 0.0
