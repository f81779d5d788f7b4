// From metres to pixels and back. A view is {x, y, scale}: the point in the middle, and pixels per metre; y points north, so up.

export const project = (view, size, [x, y]) => [size.width / 2 + (x - view.x) * view.scale, size.height / 2 - (y - view.y) * view.scale];

export const unproject = (view, size, [px, py]) => [view.x + (px - size.width / 2) / view.scale, view.y - (py - size.height / 2) / view.scale];

export const LIMITS = { least: 1e-5, most: 200 };

/** The view that holds all points with a margin around them. */
export function fit(points, size) {
  const known = points.filter((point) => point.every(Number.isFinite));
  const [xs, ys] = [known.map((point) => point[0]), known.map((point) => point[1])];
  const range = (values) => values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
  const [[left, right], [bottom, top]] = known.length ? [range(xs), range(ys)] : [[0, 0], [0, 0]];
  const alone = right === left && top === bottom;
  const [width, height] = [Math.max(right - left, alone ? 200 : 20), Math.max(top - bottom, alone ? 200 : 20)];
  const scale = Math.min((size.width - 2 * marginOf(size)) / width, (size.height - 2 * marginOf(size)) / height);
  return { x: (left + right) / 2, y: (bottom + top) / 2, scale: clamp(scale) };
}

const marginOf = (size) => Math.min(64, size.width / 8, size.height / 8);

const clamp = (scale) => Math.min(Math.max(scale, LIMITS.least), LIMITS.most);

/** Nearer or farther by a factor; the point under the pixel stays where it is. */
export function zoom(view, size, pixel, factor) {
  const before = unproject(view, size, pixel);
  const scale = clamp(view.scale * factor);
  const after = unproject({ ...view, scale }, size, pixel);
  return { x: view.x + before[0] - after[0], y: view.y + before[1] - after[1], scale };
}

export const pan = (view, dx, dy) => ({ ...view, x: view.x - dx / view.scale, y: view.y + dy / view.scale });

/** The round distance in metres (1, 2 or 5 with zeros) that is at least this many pixels long. */
export function round(scale, pixels) {
  const least = pixels / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => step >= least * 0.999);
}

/** Grid lines of one axis: the multiples of `step` between two values. */
export function lines(low, high, step) {
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.max(0, Math.floor(high / step) - first + 1) }, (_, i) => (first + i) * step);
}

/** A position as a hand can mean it at this scale: to a metre, or finer when near. */
export function snap(view, point) {
  const step = Math.min(10, Math.max(0.1, round(view.scale, 2)));
  return point.map((part) => Number((Math.round(part / step) * step).toFixed(1)));
}
