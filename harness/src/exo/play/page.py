"""The page as it is served: one document with its scripts and styles, and a policy that forbids everything else."""

import json
from importlib.resources import files

from exo.play.bench import Bench

#: Marker in `play.html` → file below `exo/web`.
INLINED = {
    "/*uplot.css*/": "uplot/uPlot.min.css",
    "/*play.css*/": "play/play.css",
    "/*uplot.js*/": "uplot/uPlot.iife.min.js",
    "/*replay.js*/": "replay/replay.js",
    **{f"/*{name}.js*/": f"play/{name}.js" for name in ("link", "told", "hand", "knobs", "charts", "play")},
}


def html(bench: Bench, *, nonce: str) -> str:
    """The document. `nonce` is what `policy` allows scripts by."""
    web = files("exo") / "web"
    text = (web / "play" / "play.html").read_text(encoding="utf-8")
    text = text.replace("NONCE", nonce).replace("TITLE", bench.title).replace("BENCH", _described(bench))
    for marker, name in INLINED.items():
        text = text.replace(marker, (web.joinpath(*name.split("/"))).read_text(encoding="utf-8"))
    return text


def policy(*, nonce: str, host: str) -> str:
    """The Content-Security-Policy: own scripts, own socket, nothing else. The drawing brings its styles along."""
    return (
        f"default-src 'none'; script-src 'nonce-{nonce}'; style-src 'unsafe-inline'; img-src data: blob:; "
        f"connect-src ws://{host}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )


def _described(bench: Bench) -> str:
    document = {
        "kind": bench.kind,
        "title": bench.title,
        "longest": bench.longest,
        "strongest": bench.strongest,
        "axes": list(bench.force),
        "position": bench.position,
        "knobs": [knob.as_json() for knob in bench.knobs],
        "switches": list(bench.switches),
        "panels": bench.panels,
        "forces": {keys[0]: axis for axis, keys in enumerate(bench.force.values())},
    }
    # Nothing in it ends the script element.
    return json.dumps(document, ensure_ascii=True).replace("<", "\\u003c")
