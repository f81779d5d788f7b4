// A modal dialog: the browser keeps the focus inside, Escape closes it, and the focus goes back to where it was.

import { html, useLayoutEffect, useRef } from "./vendor.js";

export function Dialog({ title, close, children, wide }) {
  const ref = useRef();
  // Before anything else happens: keys that are pressed right after a click belong to the dialog.
  useLayoutEffect(() => {
    const before = document.activeElement;
    ref.current.showModal();
    return () => before && before.isConnected && before.focus();
  }, []);
  const cancel = (event) => {
    event.preventDefault();
    close();
  };
  return html`<dialog ref=${ref} class=${wide ? "wide" : ""} aria-labelledby="dialog-title" onCancel=${cancel}>
    <header><h2 id="dialog-title">${title}</h2><button class="plain" aria-label="Close" onClick=${close}>✕</button></header>
    ${children}
  </dialog>`;
}

/** A sentence that says what was refused, announced at once. */
export const Refusal = ({ text, id }) => html`<p class="refusal" id=${id} role="alert">${text || ""}</p>`;
