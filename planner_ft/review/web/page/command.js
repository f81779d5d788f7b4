// The command as it was given, its spans marked by what they say, and what they say.

import { html } from "./vendor.js";

export const ELEMENTS = {
  objective: ["Objective", "what is to be achieved"],
  target: ["Target", "where, or at what"],
  sensor: ["Sensors and data", "what is to be recorded"],
  constraint: ["Constraints", "limits, hazards, the way back"],
};

/** Cuts [0, length) wherever a span starts or ends: [{start, end, elements, lit}]. Positions count characters, not UTF-16 units. */
export function segments(length, elements, lit) {
  const inside = (n) => Math.min(Math.max(n, 0), length);
  const cuts = new Set([0, length]);
  for (const { start, end } of elements) cuts.add(inside(start)).add(inside(end));
  for (const [start, end] of lit) cuts.add(inside(start)).add(inside(end));
  const ordered = [...cuts].sort((a, b) => a - b);
  return ordered.slice(0, -1).map((start, i) => ({
    start,
    end: ordered[i + 1],
    elements: elements.filter((span) => span.start <= start && span.end >= ordered[i + 1]).map((span) => span.element),
    lit: lit.some(([from, to]) => from <= start && to >= ordered[i + 1]),
  }));
}

export function Command({ store }) {
  const { command, ontology } = store.plan.document;
  const letters = [...command];
  const parts = segments(letters.length, ontology.elements, store.lit);
  return html`<section class="panel" aria-labelledby="command-title">
    <h2 id="command-title">Command</h2>
    <blockquote class="command" dir="auto" tabindex=${letters.length > 600 ? 0 : null}>${parts.map(({ start, end, elements, lit }) => {
      const text = letters.slice(start, end).join("");
      if (!elements.length && !lit) return text;
      return html`<span key=${start} class=${[...elements, lit ? "lit" : ""].join(" ")} title=${elements.map((name) => ELEMENTS[name][0]).join(", ")}>${text}</span>`;
    })}</blockquote>
    ${(ontology.elements.length > 0 || ontology.missing.length > 0) && html`<dl class="legend">${Object.entries(ELEMENTS).map(([element, [name, meaning]]) => {
      const said = ontology.elements.filter((span) => span.element === element);
      return html`<div key=${element}><dt class=${element} title=${meaning}>${name}</dt>
        <dd>${said.length ? said.map((span) => `“${span.text}”`).join(", ") : html`<em>not said</em>`}</dd></div>`;
    })}</dl>`}
  </section>`;
}
