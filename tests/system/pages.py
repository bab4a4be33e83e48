"""What a report's page says, read as text: rows of its tables and the signals that are packed into it."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from lxml import html

from exo.report import packed


class Page:
    """A written page."""

    def __init__(self, path: Path) -> None:
        self.text = path.read_text(encoding="utf-8")
        self.root = html.fromstring(self.text)

    def rows(self, scenario: str) -> dict[str, dict[str, str]]:
        """Of each number of a scenario: its cells by what they are, and `change` where it has changed."""
        found = {}
        for row in self.root.xpath(f'//tbody[@data-of="{scenario}"]/tr'):
            cells = {cell.get("data-is", ""): said(cell) for cell in row.iter("td")}
            found[row.xpath(".//code/text()")[0]] = {**cells, "change": row.get("data-c", "")}
        return found

    def paper(self) -> list[dict[str, str]]:
        """The rows beside the paper."""
        rows = self.root.xpath('//table[contains(@class, "paper")]/tbody/tr')
        return [{cell.get("data-is", ""): said(cell) for cell in row.iter("td")} for row in rows]

    def head(self, scenario: str) -> Any:
        """What is drawn of a scenario."""
        return packed.unpack(self._pack(scenario))[0]

    def signals(self, scenario: str) -> Iterator[tuple[dict[str, Any], np.ndarray, np.ndarray]]:
        """Facts, instants (s) and values of each signal."""
        head, body = packed.unpack(self._pack(scenario))
        place = 0
        for facts in head["series"]:
            size = 4 * facts["n"]
            ticks = packed.numbers_of(body[place : place + size], "<u4")
            values = packed.numbers_of(body[place + size : place + 2 * size], "<f4")
            place += 2 * size
            yield facts, np.cumsum(ticks, dtype=np.int64) * facts["step"], values

    def _pack(self, scenario: str) -> str:
        return str(self.root.xpath(f'//script[@id="pack-{scenario}"]/text()')[0])


def said(element: Any) -> str:
    """The text of an element, one blank between words."""
    return " ".join(element.text_content().split())
