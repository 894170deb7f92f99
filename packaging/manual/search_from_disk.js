// Goes before the theme's own script. A page from a disk may read no other file and start no worker from one: the index
// comes as a script, and the worker's text is here.
if (location.protocol === "file:") {
  const file = new URL("search_index.js", document.currentScript.src);
  window.Worker = class extends Worker {
    constructor() {
      super(URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" })));
    }
  };
  // Version 9 of the theme loads that script by itself; 8 asks for the index by this name.
  var __search = {
    index: new Promise((resolve) => {
      const script = document.createElement("script");
      script.src = file;
      script.onload = () => resolve(__index);
      document.head.append(script);
    }),
  };
}
