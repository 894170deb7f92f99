// Loaded before the theme's own script. A page opened from a disk must not read other files or start a worker from one,
// so the index is a script, and the worker's text is included here.
if (location.protocol === "file:") {
  const file = new URL("search_index.js", document.currentScript.src);
  window.Worker = class extends Worker {
    constructor() {
      super(URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" })));
    }
  };
  // Version 9 of the theme loads that script itself; version 8 uses this name for the index.
  var __search = {
    index: new Promise((resolve) => {
      const script = document.createElement("script");
      script.src = file;
      script.onload = () => resolve(__index);
      document.head.append(script);
    }),
  };
}
