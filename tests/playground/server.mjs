// Serves dist/playground as most servers do: what is text is compressed, and what a browser has is
// not sent again.

import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { home } from '../view/session.mjs';

const root = path.join(home, 'dist/playground');
const KINDS = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.json': 'application/json' };

/** @returns {Promise<object>} its `url`, how many bytes it has `sent`, and close() */
export async function listen() {
  const me = { sent: 0 };
  const server = http.createServer((request, answer) => {
    const name = new URL(request.url, 'http://localhost').pathname.replace(/\/$/, '/index.html');
    if (!fs.existsSync(path.join(root, name))) return answer.writeHead(404).end();
    const kind = KINDS[path.extname(name)];
    const bytes = fs.readFileSync(path.join(root, name));
    const etag = `"${bytes.length}"`;
    if (request.headers['if-none-match'] === etag) return answer.writeHead(304, { etag }).end();
    const body = kind ? gzipSync(bytes) : bytes;
    me.sent += body.length;
    return answer.writeHead(200, { etag, 'content-type': kind ?? 'application/octet-stream', ...(kind && { 'content-encoding': 'gzip' }) }).end(body);
  });
  await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });
  me.url = `http://localhost:${server.address().port}/`;
  me.close = () => server.close();
  return me;
}
