// Browsers start no worker from a page that lies on the disk. The search then runs in a hidden frame that speaks like one.
"use strict";
if (window.location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      document.body.append(this.frame);
      const inside = this.frame.contentWindow;
      inside.postMessage = (data) => {
        const message = new MessageEvent("message", { data });
        this.dispatchEvent(message);
        if (this.onmessage) this.onmessage(message);
      };
      const script = (source) => new Promise((resolve, reject) => {
        const element = inside.document.createElement("script");
        element.src = source;
        element.onload = resolve;
        element.onerror = reject;
        inside.document.body.append(element);
      });
      inside.importScripts = (...sources) => sources.reduce((before, source) => before.then(() => script(source)), Promise.resolve());
      this.ready = script(url);
    }

    postMessage(data) {
      this.ready.then(() => this.frame.contentWindow.dispatchEvent(new MessageEvent("message", { data })));
    }

    terminate() {
      this.frame.remove();
    }
  };
}
