// Goes before the theme's search worker. The index is here, so that it needs nothing of the page; a word that is typed
// before the index stands is searched for as soon as it does.
const index = INDEX;
let search;
const listen = self.addEventListener.bind(self);
self.addEventListener = (kind, listener) => { search = listener; };
let ready;
listen("message", async (event) => {
  ready ??= search({ data: { type: 0, data: {
    config: index.config, docs: index.docs, options: { pipeline: ["trimmer", "stopWordFilter"], suggestions: false } } } });
  await ready;
  // The page's own index is empty.
  if (event.data.type === 0) postMessage({ type: 1 });
  else await search(event);
});
