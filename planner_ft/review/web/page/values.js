// Parameters of a task or a skill: shown with their unit, changed in place. The program checks a value; what it refuses is said at the field.

import { Refusal } from "./dialog.js";
import { same, unitOf, withUnit } from "./format.js";
import { html, useLayoutEffect, useRef, useState } from "./vendor.js";

const isUnresolved = (value, store) => same(value, store.plan.vocabulary.unresolved);

/** A field's text as a value of the parameter's type; text that is no number stays text, for the program to refuse. */
export function parse(type, text) {
  const trimmed = text.trim();
  const numeric = (part) => (part.trim() === "" || Number.isNaN(Number(part.trim().replace("\u2212", "-"))) ? part.trim() : Number(part.trim().replace("\u2212", "-")));
  if (type === "number" || type === "integer") return numeric(/^[^.,]*,[^.,]*$/.test(trimmed) ? trimmed.replace(",", ".") : trimmed);
  if (type === "position") return trimmed.replace(/^[([]|[)\]]$/g, "").split(/[,;\s]+/).filter(Boolean).map(numeric);
  if (type === "polygon") return trimmed.split(/[;\n]+/).filter((row) => row.trim()).map((row) => parse("position", row));
  if (type === "texts") return trimmed.split(/[,\n]/).map((part) => part.trim()).filter(Boolean);
  return trimmed;
}

/** The other way: what stands in the field when a value is opened. */
export function written(type, value) {
  if (value === undefined || value === null) return "";
  if (type === "position" && Array.isArray(value)) return value.join(", ");
  if (type === "polygon" && Array.isArray(value)) return value.map((corner) => corner.join(", ")).join("\n");
  if (type === "texts" && Array.isArray(value)) return value.join(", ");
  return String(value);
}

const HINTS = { position: "x, y in metres east and north of home", polygon: "one corner x, y in each line", texts: "with commas between them" };

/** The field for one parameter. */
export function Field({ parameter, value, id, onInput, onKeyDown, focus, describedby }) {
  const field = useRef();
  useLayoutEffect(() => {
    if (!focus) return;
    field.current.focus();
    field.current.select();
  }, []);
  const common = { id, ref: field, value, onInput: (event) => onInput(event.target.value), onKeyDown, "aria-describedby": describedby, autocomplete: "off", spellcheck: false };
  return html`${parameter.type === "polygon" ? html`<textarea rows="4" ...${common}></textarea>`
    : html`<input type="text" class=${parameter.type} inputmode=${["number", "integer"].includes(parameter.type) ? "decimal" : null} ...${common} />`}
    ${unitOf(parameter.unit) && html`<span class="unit">${unitOf(parameter.unit)}</span>`}`;
}

export const hint = (parameter) => [parameter.description, HINTS[parameter.type], limits(parameter)].filter(Boolean).join("; ");

function limits({ minimum, maximum }) {
  const has = (limit) => limit !== null && limit !== undefined;
  if (has(minimum) && has(maximum)) return `${minimum} to ${maximum}`;
  if (has(minimum)) return `at least ${minimum}`;
  return has(maximum) ? `at most ${maximum}` : "";
}

/** One value: a button that opens its field. `change(value | null)` answers null or the sentence that refuses it. */
export function Value({ parameter, value, change, store, label, startOpen, closed }) {
  const [open, setOpen] = useState(Boolean(startOpen));
  const [text, write] = useState(written(parameter.type, value));
  const [began, begin] = useState(value);
  const [refused, refuse] = useState(null);
  const button = useRef();
  const id = useRef(`v${Math.random().toString(36).slice(2)}`).current;
  const start = () => {
    write(isUnresolved(value, store) ? "" : written(parameter.type, value));
    begin(value);
    refuse(null);
    setOpen(true);
  };
  const end = () => {
    setOpen(false);
    if (closed) closed();
    setTimeout(() => button.current && button.current.focus());
  };
  const send = async (next) => {
    const sentence = await change(next);
    if (sentence) refuse(sentence);
    else end();
  };
  const submit = (event) => {
    event.preventDefault();
    send(parse(parameter.type, text));
  };
  const keys = (event) => {
    event.stopPropagation();
    if (event.key === "Escape") end();
  };
  if (!open) {
    const unknown = isUnresolved(value, store);
    return html`<button ref=${button} class=${`value ${unknown ? "unresolved" : ""}`} aria-label=${`${label} ${parameter.name}: ${unknown ? "place not known" : withUnit(value, parameter.unit)}, change`}
      onClick=${start}>${unknown ? "place not known" : withUnit(value, parameter.unit)}</button>`;
  }
  return html`<form class="edit" onSubmit=${submit}>
    <label class="unseen" for=${id}>${`${label} ${parameter.name}`}</label>
    <${Field} id=${id} parameter=${parameter} value=${text} onInput=${write} onKeyDown=${keys} focus=${true} describedby=${`${id}-hint ${id}-refused`} />
    <button class="act">Save</button>
    ${!parameter.required && value !== undefined && html`<button type="button" onClick=${() => send(null)}>Leave out</button>`}
    <button type="button" class="plain" onClick=${end}>Cancel</button>
    <small id=${`${id}-hint`}>${hint(parameter)}</small>
    ${!same(began, value) && html`<small class="meanwhile" role="status">Somebody changed it meanwhile: it is ${value === undefined ? "left out" : withUnit(value, parameter.unit)} now.</small>`}
    <${Refusal} id=${`${id}-refused`} text=${refused} />
  </form>`;
}

/** Offers the parameters that are not given yet. */
export function Add({ known, given, change, store, label, short }) {
  const [name, choose] = useState("");
  const left = known.filter((parameter) => !(parameter.name in given));
  const parameter = left.find((one) => one.name === name);
  if (!left.length) return null;
  if (parameter) return html`<span class="adding">${parameter.name} <${Value} parameter=${parameter} store=${store} label=${label} startOpen=${true} closed=${() => choose("")} change=${(value) => change(parameter.name, value)} /></span>`;
  return html`<select class="add" aria-label=${`Add a value to ${label}`} value="" onChange=${(event) => choose(event.target.value)}>
    <option value="">${short ? "+" : "+ value"}</option>${left.map((one) => html`<option key=${one.name} value=${one.name} title=${one.description}>${one.name}</option>`)}</select>`;
}

/** A parameter that the definition does not know, of a plan made with another one. */
export const unknownParameter = (name, value) => ({ name, type: Array.isArray(value) ? "position" : typeof value === "number" ? "number" : "text", unit: null, required: true, description: "not in the definition" });

