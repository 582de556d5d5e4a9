// Keeps the page for use without a network: its files, as they were built together.

const NAME = 'ev3dev-playground-@BUILD@';
const FILES = '@FILES@'.split(' ');

addEventListener('install', (event) => event.waitUntil((async () => {
  await (await caches.open(NAME)).addAll(FILES.map((file) => new Request(file, { cache: 'no-cache' })));
  await skipWaiting();
})()));

addEventListener('activate', (event) => event.waitUntil((async () => {
  for (const name of await caches.keys()) if (name.startsWith('ev3dev-playground-') && name !== NAME) await caches.delete(name);
  await clients.claim();
})()));

/** As it is kept; the browser looks for a new build of this file by itself, and has it the next time. */
addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method !== 'GET' || new URL(request.url).origin !== location.origin) return;
  event.respondWith((async () => {
    const kept = await (await caches.open(NAME)).match(request, { ignoreSearch: true });
    return kept ?? fetch(request);
  })());
});
