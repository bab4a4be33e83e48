// The socket: what is sent, what comes, and a new one where the old one is lost.
"use strict";

/** `taken(message)` gets each message; `open(flag)` hears whether there is a connection. Answers what sends. */
function playLink(taken, open) {
  const token = new URLSearchParams(location.search).get("token") ?? "";
  let socket = null;
  function connect() {
    socket = new WebSocket(`ws://${location.host}/live?token=${encodeURIComponent(token)}`);
    socket.onopen = () => open(true);
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      taken(message);
      // Only who says so gets the next states.
      if (message.state) socket.send('{"seen":true}');
    };
    socket.onclose = () => {
      open(false);
      setTimeout(connect, 1000);
    };
  }
  connect();
  return (message) => {
    if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
  };
}
