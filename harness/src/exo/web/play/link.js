// The socket: what is sent, what comes, and a new one where the old one is lost.
"use strict";

/** The run tells something every second at least; after this silence nobody is there (ms). */
const PLAY_SILENCE = 3000;
const PLAY_GONE = "The connection to exo play is gone. If the command has ended, start it again and open the address that it prints.";
const PLAY_SILENT = "exo play has not answered for some seconds: it is stopped, or this machine is too busy.";

/**
 * `taken(message)` gets each message; `heard(sentence)` what is wrong with the connection, "" while nothing is.
 * Answers what sends; that answers whether anybody is there.
 */
function playLink(taken, heard) {
  const token = new URLSearchParams(location.search).get("token") ?? "";
  let [socket, last, trouble] = [null, 0, ""];
  const say = (sentence) => {
    if (trouble !== sentence) heard((trouble = sentence));
  };
  function connect() {
    socket = new WebSocket(`ws://${location.host}/live?token=${encodeURIComponent(token)}`);
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      last = performance.now();
      say("");
      taken(message);
      // Only who says so gets the next states.
      if (message.state && socket.readyState === WebSocket.OPEN) socket.send('{"seen":true}');
    };
    socket.onclose = (event) => {
      last = 0;
      say(event.reason || PLAY_GONE);
      setTimeout(connect, 1000);
    };
  }
  connect();
  // What waits in the queue after a sleep of the computer comes before the second look.
  let looks = 0;
  setInterval(() => {
    looks = last && performance.now() - last > PLAY_SILENCE ? looks + 1 : 0;
    if (looks > 1) say(PLAY_SILENT);
  }, 500);
  return (message) => {
    const open = socket.readyState === WebSocket.OPEN;
    // To let go while nobody answers waits in the socket. All else would act too late, and is said not to be sent.
    if (open && (!trouble || message.hand)) socket.send(JSON.stringify(message));
    return open && !trouble;
  };
}
