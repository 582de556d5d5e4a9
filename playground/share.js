// A program in a link: what is shared, as JSON, compressed, in base64 for addresses.

const through = (bytes, stream) => new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer();

export async function toFragment(shared) {
  const bytes = new Uint8Array(await through(new TextEncoder().encode(JSON.stringify(shared)), new CompressionStream('deflate-raw')));
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join('')).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

/** Fails if it is none. */
export async function fromFragment(fragment) {
  const bytes = Uint8Array.from(atob(fragment.replace(/-/g, '+').replace(/_/g, '/')), (letter) => letter.charCodeAt(0));
  const { name, text, world, task } = JSON.parse(new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw'))));
  if (typeof name !== 'string' || typeof text !== 'string') throw new Error('no program');
  const lines = Array.isArray(world) ? world.filter((line) => /^(choose|begin|add|move|remove) /.test(line)) : [];
  return { name, text, world: lines, task: typeof task === 'string' ? task : '' };
}
