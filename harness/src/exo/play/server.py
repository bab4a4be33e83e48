"""Page and socket of `exo play`, for this machine only.

Whoever wants in needs the token of the address. The Host header must name this machine, so that a name which an
attacker points at 127.0.0.1 is refused; the socket's Origin must be the page itself, so that other pages are refused.
A message is at most 4 kB long. States are sent while the page says that it has seen the ones before: a slow page gets
fewer, each as new as it can be.
"""

import asyncio
import errno
import json
import secrets
import socket as sockets
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from pathlib import Path
from time import monotonic

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware
from starlette.middleware.trustedhost import TrustedHostMiddleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from exo.errors import ExoError
from exo.play import messages, page
from exo.play.live import Live, State

HOST = "127.0.0.1"
NAMES = (HOST, "localhost")
#: States a second, and how many a page gets before it has seen the first of them.
RATE, AHEAD = 30.0, 4
#: From then on a page that gets nothing would believe that nobody is there (s).
STILL = 1.0
#: What the page says once it has drawn a state, and when its hand lets go.
SEEN = '{"seen":true}'
LETS_GO = {'{"hand":{"target":null}}', '{"hand":{"push":[0]}}', '{"hand":{"push":[0,0,0]}}'}
#: Messages a second that a page may send, and how many at once.
MOST, BURST = 150.0, 300.0
#: Pages at once.
TABS = 16
#: RFC 6455: a policy is violated; try again later.
REFUSED, BUSY = 1008, 1013


def bind(port: int) -> sockets.socket:
    """A listening place on this machine; port 0 takes a free one. ExoError, if the port is taken."""
    found = sockets.socket(sockets.AF_INET, sockets.SOCK_STREAM)
    try:
        found.setsockopt(sockets.SOL_SOCKET, sockets.SO_REUSEADDR, 1)
        found.bind((HOST, port))
        # Another process that listens here is only met now.
        found.listen()
    except OSError as error:
        found.close()
        what = "is taken" if error.errno == errno.EADDRINUSE else f"cannot be used: {error.strerror}"
        raise ExoError(f"--port {port}: {what}; expected a free port, or 0 for any") from error
    return found


def address(bound: sockets.socket, token: str) -> str:
    """What the browser opens."""
    return f"http://{HOST}:{bound.getsockname()[1]}/?token={token}"


def serve(live: Live, bound: sockets.socket, *, token: str, out: Path, run_options: str = "") -> None:
    """Serves until the process is interrupted."""
    server(live, token=token, out=out, run_options=run_options).run(sockets=[bound])


def server(live: Live, *, token: str, out: Path, run_options: str = "") -> uvicorn.Server:
    """A server that `run` or `serve` starts."""
    config = uvicorn.Config(
        application(live, token=token, out=out, run_options=run_options),
        log_level="critical",
        access_log=False,
        server_header=False,
        lifespan="off",
        ws="websockets-sansio",
        ws_max_size=messages.LONGEST,
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=1,
    )
    return uvicorn.Server(config)


def application(live: Live, *, token: str, out: Path, run_options: str = "") -> Starlette:
    """The page at `/`, the socket at `/live`, nothing else."""
    tabs = Tabs(live, token=token, take=lambda text: messages.take(live, text, out=out, run_options=run_options))

    async def show(request: Request) -> Response:
        if not _same(request.query_params.get("token", ""), token):
            said = "This address has no valid token; expected the address that `exo play` has printed.\n"
            return PlainTextResponse(said, status_code=403, headers=_headers())
        nonce = secrets.token_urlsafe(16)
        policy = page.policy(nonce=nonce, host=request.headers["host"])
        return HTMLResponse(page.html(live.bench, nonce=nonce), headers=_headers(policy))

    async def missing(_request: Request, _error: Exception) -> Response:
        return PlainTextResponse("Nothing is here.\n", status_code=404, headers=_headers())

    return Starlette(
        routes=[Route("/", show), WebSocketRoute("/live", tabs.open)],
        middleware=[Middleware(TrustedHostMiddleware, allowed_hosts=list(NAMES), www_redirect=False)],
        exception_handlers={404: missing},
    )


def _same(given: str, token: str) -> bool:
    return secrets.compare_digest(given.encode(), token.encode())


def _headers(policy: str = "default-src 'none'") -> dict[str, str]:
    return {
        "Content-Security-Policy": policy,
        "Cache-Control": "no-store",
        "Referrer-Policy": "no-referrer",
        "X-Content-Type-Options": "nosniff",
        "Cross-Origin-Resource-Policy": "same-origin",
    }


class Tabs:
    """The pages that are open."""

    def __init__(self, live: Live, *, token: str, take: Callable[[str], messages.Answer]) -> None:
        self._live = live
        self._token = token
        self._take = take
        self._open = 0
        #: What of the hand → who has moved it last.
        self._moved: dict[str, Tab] = {}

    async def open(self, socket: WebSocket) -> None:
        """One page, from its socket's opening to its end."""
        own = f"http://{socket.headers.get('host', '')}"
        if socket.headers.get("origin") != own or not _same(socket.query_params.get("token", ""), self._token):
            await socket.close(REFUSED)
            return
        if self._open >= TABS:
            # A browser tells a page nothing of a socket that is refused: it is accepted, to say why.
            with suppress(WebSocketDisconnect, RuntimeError):
                await socket.accept()
                await socket.close(BUSY, f"{TABS} pages are open, as many as there may be. Close one of them.")
            return
        self._open += 1
        tab = Tab(socket, self._live)
        try:
            await socket.accept()
            sender = asyncio.create_task(tab.send_states())
            try:
                async for text in tab.messages():
                    # What writes a file does not hold up the other pages.
                    answer = await run_in_threadpool(self._take, text)
                    if answer is not None:
                        await tab.send(answer)
                    else:
                        moved = messages.moved(text)
                        self._moved |= dict.fromkeys(moved, tab)
                        if moved:
                            tab.acts = text not in LETS_GO
            finally:
                sender.cancel()
        except (WebSocketDisconnect, RuntimeError):
            pass
        finally:
            self._open -= 1
            # A page that is closed while it grips lets go, and ceases to push; what another page does stays.
            mine = {what for what, by in self._moved.items() if by is tab}
            for what in mine:
                del self._moved[what]
            nothing = {"target": None, "push": [0.0] * len(self._live.bench.force)}
            self._live.hand(**{what: nothing[what] for what in mine})


class Tab:
    """One page: what it gets and what it may send."""

    def __init__(self, socket: WebSocket, live: Live) -> None:
        self._socket = socket
        self._live = live
        self._unseen = 0
        #: Whether the page may hold the handle, or push.
        self.acts = False
        self._one = asyncio.Lock()
        self._left, self._filled, self._warned = BURST, monotonic(), 0.0

    async def send(self, what: dict[str, object]) -> None:
        """One message to the page."""
        async with self._one:
            # ASCII: half of a surrogate pair, which JSON can write, has no other way through.
            await self._socket.send_text(json.dumps(what))

    async def send_states(self) -> None:
        """The newest state, as often as the page can take it; once in a while also where nothing has changed."""
        shape, last, told = 0, None, 0.0
        with suppress(WebSocketDisconnect, RuntimeError):
            while True:
                state = self._live.state
                news = state != last or monotonic() - told >= STILL
                if self._unseen < AHEAD and state is not None and news:
                    run, geometry = self._live.geometry
                    if run != shape and geometry is not None:
                        shape = run
                        await self.send({"geometry": geometry})
                    await self._send_state(state)
                    last, told = state, monotonic()
                await asyncio.sleep(1.0 / RATE)

    async def _send_state(self, state: State) -> None:
        self._unseen += 1
        await self.send({"state": state.as_json()})

    async def messages(self) -> AsyncIterator[str]:
        """What the page sends, without what it has seen and without what is too much: to let go never is."""
        while True:
            message = await self._socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            text = message.get("text")
            if text == SEEN:
                self._unseen = 0
            elif not self._allowed() and not (text in LETS_GO and self.acts):
                await self._warn()
            elif text is None:
                await self.send({"error": "a message of bytes; expected text"})
            else:
                yield text

    def _allowed(self) -> bool:
        now = monotonic()
        self._left = min(BURST, self._left + MOST * (now - self._filled))
        self._filled = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True

    async def _warn(self) -> None:
        now = monotonic()
        if now - self._warned >= 1.0:
            self._warned = now
            await self.send({"error": f"too many messages: some were left out; expected at most {MOST:g} a second"})
