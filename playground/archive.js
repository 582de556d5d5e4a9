// All that the worker needs, in one file: a header, which says where each part is, and the parts,
// compressed. A server need not know how to.

/** @returns {Promise<Map<string, Uint8Array>>} the parts by their names */
export async function unpack(stream) {
  const bytes = new Uint8Array(await new Response(stream.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
  const begin = 4 + new DataView(bytes.buffer).getUint32(0);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, begin)));
  return new Map(header.map(([name, from, to]) => [name, bytes.subarray(begin + from, begin + to)]));
}

/** @param {object} parts  bytes by name */
export function pack(parts) {
  let at = 0;
  const header = new TextEncoder().encode(JSON.stringify(Object.entries(parts).map(([name, bytes]) => [name, at, at += bytes.length])));
  const all = new Uint8Array(4 + header.length + at);
  new DataView(all.buffer).setUint32(0, header.length);
  all.set(header, 4);
  at = 4 + header.length;
  for (const bytes of Object.values(parts)) {
    all.set(bytes, at);
    at += bytes.length;
  }
  return all;
}
