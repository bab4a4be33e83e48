// What `packed.py` has packed: head and body of a <script> that the browser does not run.

/** The head and a reader of the body's blocks, from the element `id`; null where it is not there. */
async function unpack(id) {
  const element = document.getElementById(id);
  if (!element) return null;
  const letters = atob(element.textContent.trim());
  const packed = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const plain = await new Response(stream).arrayBuffer();
  const length = new DataView(plain).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(plain, 4, length)));
  return { head, body: blocksOf(new Uint8Array(plain, 4 + length)) };
}

/** Reads the blocks of a body, one after the other. */
function blocksOf(body) {
  let place = 0;
  function take(length) {
    place += length;
    return body.subarray(place - length, place);
  }
  /** `count` numbers whose bytes are sorted: the lowest of each, then the next, … */
  function numbers(count, Kind) {
    const sorted = take(4 * count);
    const bytes = new Uint8Array(4 * count);
    for (let k = 0; k < count; k++) {
      for (let b = 0; b < 4; b++) bytes[4 * k + b] = sorted[b * count + k];
    }
    return new Kind(bytes.buffer);
  }
  return { bytes: take, ticks: (count) => numbers(count, Uint32Array), values: (count) => numbers(count, Float32Array) };
}
