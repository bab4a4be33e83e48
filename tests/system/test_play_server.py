"""The socket of `exo play`: who may come in, what becomes of garbage and floods, and that no page holds up another."""

import json
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import monotonic, sleep
from typing import Any
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from exo import loop
from exo.errors import ExoError
from exo.play import bench as benches
from exo.play import live as lives
from exo.play import server
from exo.play.live import Live

TOKEN = "a-token-of-the-tests"
#: The other tests take the processor, too.
GOES_ON = ("running", "slower than real time")


@dataclass(frozen=True)
class Served:
    """A server that runs."""

    live: Live
    port: int
    out: Path

    def get(self, path: str, host: str = "") -> tuple[int, str, dict[str, str]]:
        """Status, text and headers of a page."""
        request = Request(f"http://127.0.0.1:{self.port}{path}", headers={"Host": host} if host else {})
        try:
            with urlopen(request, timeout=10) as answer:
                return answer.status, answer.read().decode(), {k.lower(): v for k, v in answer.headers.items()}
        except HTTPError as error:
            return error.code, error.read().decode(), {k.lower(): v for k, v in error.headers.items()}

    def tab(
        self, *, token: str = TOKEN, origin: str | None = "own", host: str = "", **options: Any
    ) -> ClientConnection:
        """A socket as a page opens it."""
        own = f"http://127.0.0.1:{self.port}"
        headers = {"Host": host} if host else {}
        if origin is not None:
            headers["Origin"] = own if origin == "own" else origin
        uri = f"ws://127.0.0.1:{self.port}/live?token={token}"
        if host:
            # The client sets Host itself: connect by that name.
            uri = f"ws://{host}:{self.port}/live?token={token}"
            options["sock"] = socket.create_connection(("127.0.0.1", self.port))
            del headers["Host"]
        return connect(uri, additional_headers=headers, compression=None, proxy=None, **options)


@pytest.fixture(scope="module")
def served(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """The testbed, served from a thread."""
    out = tmp_path_factory.mktemp("played")
    bound = server.bind(0)
    with bound, Live(benches.TESTBED, fmu_dir=fmu_dir, engine=loop.fastest()) as live:
        live.begun()
        running = server.server(live, token=TOKEN, out=out)
        thread = threading.Thread(target=lambda: running.run(sockets=[bound]))
        thread.start()
        yield Served(live, bound.getsockname()[1], out)
        running.should_exit = True
        thread.join(timeout=10)
        assert not thread.is_alive()


def answer(tab: ClientConnection, kind: str, *, within: float = 5.0) -> Any:
    """The next message of a kind; what else comes is seen and left out."""
    end = monotonic() + within
    while monotonic() < end:
        message = json.loads(tab.recv(timeout=within))
        if "state" in message:
            tab.send('{"seen":true}')
        if kind in message:
            return message[kind]
    return pytest.fail(f"no {kind} within {within} s")


def state_where(tab: ClientConnection, test: Callable[[Any], bool]) -> Any:
    """The first state that a page gets and that satisfies `test`."""
    for _ in range(200):
        state = answer(tab, "state")
        if test(state):
            return state
    return pytest.fail("no such state among 200")


def test_the_page_opens_with_the_token_and_asks_for_nothing_elsewhere(served: Served) -> None:
    status, text, headers = served.get(f"/?token={TOKEN}")
    assert status == 200
    assert benches.TESTBED.title in text
    assert "/*" + "play.js*/" not in text
    policy = headers["content-security-policy"]
    assert policy.startswith("default-src 'none'; script-src 'nonce-")
    assert f"connect-src ws://127.0.0.1:{served.port};" in policy
    assert "'unsafe-eval'" not in policy
    assert headers["cache-control"] == "no-store"
    assert headers["referrer-policy"] == "no-referrer"


@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", f"?token={TOKEN}x", "?token=%C3%A9"])
def test_the_page_is_refused_without_the_token(query: str, served: Served) -> None:
    status, text, _ = served.get(f"/{query}")
    assert status == 403
    assert text.startswith("This address has no valid token; expected")


@pytest.mark.parametrize("host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "0.0.0.0"])
def test_a_name_that_is_not_this_machine_is_refused(host: str, served: Served) -> None:
    assert served.get(f"/?token={TOKEN}", host=host)[0] == 400


@pytest.mark.parametrize("path", ["/favicon.ico", "/live", "/../etc/passwd", "/docs", "/play.js", "//"])
def test_nothing_else_is_served(path: str, served: Served) -> None:
    status, text, headers = served.get(f"{path}?token={TOKEN}")
    assert (status, text) == (404, "Nothing is here.\n")
    assert headers["content-security-policy"] == "default-src 'none'"


@pytest.mark.parametrize(
    "how",
    [
        {"token": ""},
        {"token": "wrong"},
        {"origin": None},
        {"origin": "null"},
        {"origin": "http://evil.example"},
        {"origin": "http://127.0.0.1:1"},
        {"host": "evil.example", "origin": "http://evil.example"},
    ],
    ids=str,
)
def test_the_socket_is_refused(how: dict[str, Any], served: Served) -> None:
    port = served.port
    if how.get("origin") == "http://evil.example" and "host" in how:
        how = {**how, "origin": f"http://evil.example:{port}"}
    with pytest.raises(InvalidStatus) as refused, served.tab(**how):
        pass
    assert refused.value.response.status_code in (400, 403)


def test_the_port_is_open_on_this_machine_alone(served: Served) -> None:
    outside = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)}
    for address in outside - {"127.0.0.1"}:
        with pytest.raises(OSError, match=r"refused|timed out"):
            socket.create_connection((address, served.port), timeout=2)
    assert server.HOST == "127.0.0.1"


def test_a_page_sets_a_knob_and_another_page_sees_it(served: Served) -> None:
    with served.tab() as one, served.tab() as two:
        assert answer(two, "geometry")["kind"] == "testbed"
        one.send('{"set": {"name": "K", "to": 21.5}}')
        assert state_where(two, lambda state: state["settings"]["K"] == 21.5)
        two.send('{"pause": true}')
        assert state_where(one, lambda state: state["paused"])["status"] == "paused"
        two.send('{"pause": false}')
        assert state_where(one, lambda state: not state["paused"])


def test_a_page_that_closes_while_it_grips_lets_go(served: Served) -> None:
    with served.tab() as other:
        with served.tab() as tab:
            tab.send('{"hand": {"target": [0.1], "push": [1.0]}}')
            state_where(tab, lambda state: state["target"] == [0.1])
            state_where(other, lambda state: state["target"] == [0.1])
        state_where(other, lambda state: state["target"] is None and state["force"] == [0.0])


def test_a_page_that_grips_lets_go_at_its_end_whatever_another_page_sets_meanwhile(served: Served) -> None:
    with served.tab() as other:
        with served.tab() as tab:
            tab.send('{"hand": {"target": [0.1]}}')
            state_where(tab, lambda state: state["target"] == [0.1])
            other.send('{"hand": {"stiffness": 300, "push": [1.5]}}')
            state_where(other, lambda state: state["stiffness"] == 300 and state["push"] == [1.5])
        after = state_where(other, lambda state: state["target"] is None)
        # What the other page does stays.
        assert after["push"] == [1.5]
    with served.tab() as tab:
        assert state_where(tab, lambda state: state["push"] == [0.0])


def test_garbage_is_answered_and_the_page_goes_on(served: Served) -> None:
    with served.tab() as tab:
        huge = f'{{"hand": {{"stiffness": 1{"0" * 400}}}}}'
        for text in ("", "{", "null", "[[", '{"set": null}', "😀", '{"hand": {"target": "x"}}', huge):
            tab.send(text)
            assert "expected" in answer(tab, "error")
        # Half of a surrogate pair.
        tab.send('{"set": {"name": "\\ud800", "to": 1}}')
        assert answer(tab, "error").startswith("no knob \ud800")
        tab.send(b"\x00\xff")
        assert answer(tab, "error") == "a message of bytes; expected text"
        assert answer(tab, "state")["status"] in GOES_ON


def test_a_message_that_is_too_large_ends_its_socket_alone(served: Served) -> None:
    with served.tab() as other:
        with served.tab() as tab:
            tab.send(json.dumps({"save": "x" * 4000}))
            assert "expected" in answer(tab, "error")
            tab.send(json.dumps({"save": "x" * 5000}))
            with pytest.raises(ConnectionClosed) as closed:
                answer(tab, "nothing else")
            assert closed.value.rcvd is not None
            assert closed.value.rcvd.code == 1009
        assert answer(other, "state")["status"] in GOES_ON


def test_a_flood_of_ten_thousand_messages_is_survived(served: Served) -> None:
    # A client that reads nothing while it sends would wait for itself once both buffers are full.
    with served.tab() as other, served.tab(max_queue=None) as flood:
        began = monotonic()
        for i in range(10_000):
            flood.send(json.dumps({"set": {"name": "K", "to": 1 + i % 59}}))
        flood.send('{"set": {"name": "K", "to": 60}}')
        before = answer(other, "state")["time"]
        said = answer(flood, "error", within=10.0)
        assert said.startswith("too many messages")
        after = state_where(other, lambda state: state["time"] > before + 0.2)
        assert after["status"] in GOES_ON
        assert monotonic() - began < 15.0
    with served.tab() as tab:
        # Not K: what was let through of the flood may come after this.
        tab.send('{"set": {"name": "D_n", "to": 1.5}}')
        state_where(tab, lambda state: state["settings"]["D_n"] == 1.5)


@pytest.mark.parametrize(
    ("grip", "let_go", "is_free"),
    [
        ('{"hand":{"target":[0.1]}}', '{"hand":{"target":null}}', lambda state: state["target"] is None),
        ('{"hand":{"push":[3]}}', '{"hand":{"push":[0]}}', lambda state: state["push"] == [0]),
    ],
)
def test_to_let_go_is_never_too_much(served: Served, grip: str, let_go: str, is_free: Callable[[Any], bool]) -> None:
    with served.tab() as other, served.tab(max_queue=None) as flood:
        flood.send(grip)
        state_where(other, lambda state: not is_free(state))
        for i in range(2_000):
            flood.send(json.dumps({"set": {"name": "K", "to": 1 + i % 59}}))
        flood.send(let_go)
        assert answer(flood, "error", within=20.0).startswith("too many messages")
        state_where(other, is_free)


def test_a_page_that_does_not_read_gets_the_newest_state_when_it_does(served: Served) -> None:
    with served.tab() as slow:
        answer(slow, "geometry")
        sleep(1.0)
        waiting = []
        try:
            while True:
                waiting.append(json.loads(slow.recv(timeout=0.2))["state"])
        except TimeoutError:
            pass
        # Of some thirty states.
        assert 1 <= len(waiting) <= server.AHEAD
        slow.send('{"seen":true}')
        now = served.live.state
        assert now is not None
        assert json.loads(slow.recv(timeout=2))["state"]["time"] >= now.time - 0.1


def test_an_fmu_that_fails_is_a_sentence_on_the_page(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: Any, **__: Any) -> None:
        raise ExoError("Testbed: fmi2DoStep failed at 0.5 s")

    with served.tab() as tab:
        with monkeypatch.context() as patched:
            patched.setattr(lives.Coupled, "advance", fails)
            state = state_where(tab, lambda state: state["failed"])
            assert state["status"] == "Testbed: fmi2DoStep failed at 0.5 s"
        tab.send('{"again": {}}')
        assert state_where(tab, lambda state: not state["failed"])["status"] in GOES_ON


def test_too_many_pages_are_told_to_come_later(served: Served) -> None:
    tabs = [served.tab() for _ in range(server.TABS)]
    try:
        with served.tab() as late, pytest.raises(ConnectionClosed) as closed:
            late.recv(timeout=5)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == server.BUSY
        assert closed.value.rcvd.reason == "16 pages are open, as many as there may be. Close one of them."
    finally:
        for tab in tabs:
            tab.close()
    end = monotonic() + 5.0
    while monotonic() < end:
        with suppress(ConnectionClosed), served.tab() as tab:
            assert answer(tab, "state")
            return
        sleep(0.05)
    pytest.fail("no page gets in after the others have gone")


def test_a_page_hears_of_a_run_that_stands_still(served: Served) -> None:
    with served.tab() as tab:
        tab.send('{"pause": true}')
        state_where(tab, lambda state: state["paused"])
        # The same again, within two seconds: a page that hears nothing says so.
        assert answer(tab, "state", within=2.0)["paused"]
        assert answer(tab, "state", within=2.0)["paused"]
        tab.send('{"pause": false}')
        state_where(tab, lambda state: not state["paused"])


def test_a_port_that_is_taken_is_a_sentence(served: Served) -> None:
    with pytest.raises(ExoError, match=f"--port {served.port}: is taken; expected a free port, or 0 for any"):
        server.bind(served.port)
