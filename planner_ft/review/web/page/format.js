// Numbers, times and values as text.

export const MINUS = "\u2212";

/** At most two decimals, with a real minus sign. */
export function number(value) {
  return String(Math.round(value * 100) / 100).replace("-", MINUS);
}

export const place = ([x, y]) => `(${number(x)}, ${number(y)})`;

export function metres(value) {
  return value >= 10000 ? `${number(Math.round(value / 100) / 10)} km` : `${number(value >= 100 ? Math.round(value) : Math.round(value * 10) / 10)} m`;
}

/** Where a point of the local frame lies on earth, to about a metre: "54.32170° N, 10.14120° E". Second order on WGS 84; files are written by the program, exactly. */
export function latitudeLongitude([x, y], { latitude, longitude }) {
  const [a, e2] = [6378137, 0.00669437999014];
  const radians = (latitude * Math.PI) / 180;
  const flat = 1 - e2 * Math.sin(radians) ** 2;
  const [across, along, slope] = [a / Math.sqrt(flat), (a * (1 - e2)) / flat ** 1.5, Math.tan(radians)];
  const north = latitude + ((y / along - (x * x * slope) / (2 * along * across)) * 180) / Math.PI;
  const east = longitude + (((x / (across * Math.cos(radians))) * (1 + (y * slope) / across)) * 180) / Math.PI;
  return `${Math.abs(north).toFixed(5)}° ${north < 0 ? "S" : "N"}, ${Math.abs(east).toFixed(5)}° ${east < 0 ? "W" : "E"}`;
}

/** At most this many letters of a name. */
export const cut = (text, most = 28) => ([...text].length > most ? `${[...text].slice(0, most - 1).join("")}…` : text);

/** 75 is "1 min 15 s", 1800 is "30 min", 7500 is "2 h 05 min". */
export function seconds(value) {
  const all = Math.round(value);
  const [hours, minutes, rest] = [Math.floor(all / 3600), Math.floor((all % 3600) / 60), all % 60];
  const two = (part, unit) => (part ? `\u00a0${String(part).padStart(2, "0")}\u00a0${unit}` : "");
  if (hours) return `${hours}\u00a0h${two(minutes, "min")}`;
  return minutes ? `${minutes}\u00a0min${two(rest, "s")}` : `${rest}\u00a0s`;
}

const isPlace = (value) => Array.isArray(value) && value.length === 2 && value.every((part) => typeof part === "number");

/** A parameter's value as text, without its unit. */
export function shown(value) {
  if (typeof value === "number") return number(value);
  if (isPlace(value)) return place(value);
  if (Array.isArray(value)) return value.map((part) => (isPlace(part) ? place(part) : String(part))).join(", ");
  return typeof value === "string" ? value : JSON.stringify(value);
}

export function unitOf(unit) {
  return !unit || unit === "count" ? "" : { deg: "°", degC: "°C" }[unit] || unit;
}

/** The value with its unit: "12 m", "135°". Positions say that they are in metres by their brackets. */
export function withUnit(value, unit) {
  const sign = typeof value === "number" ? unitOf(unit) : "";
  return shown(value) + (sign.startsWith("°") ? sign : sign && `\u00a0${sign}`);
}

export const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export const when = (time) => (time ? new Date(time).toLocaleString([], { dateStyle: "medium", timeStyle: "short" }) : "");

export const count = (n, one, many = `${one}s`) => `${n} ${n === 1 ? one : many}`;

/** "tasks 2 and 3", from the ids of a document. */
export function tasksNamed(ids, tasks) {
  const numbers = ids.map((id) => tasks.findIndex((task) => task.id === id) + 1).filter(Boolean);
  const words = numbers.length < 2 ? numbers.join("") : `${numbers.slice(0, -1).join(", ")} and ${numbers[numbers.length - 1]}`;
  return `${numbers.length === 1 ? "task" : "tasks"} ${words}`;
}
