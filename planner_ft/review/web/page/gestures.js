// Wheel, pinch, drag and tap on the chart. `act` is {zoom(pixel, factor), pan(dx, dy), tap(pixel, element), hover(pixel | null)}.

const TAP = 5;

export function gestures(svg, act) {
  const pointers = new Map();
  let moved = 0;
  let pressed = null;
  const pixel = (event) => {
    const box = svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return { distance: Math.hypot(a[0] - b[0], a[1] - b[1]), middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
  };
  const listeners = {
    wheel: (event) => {
      event.preventDefault();
      act.zoom(pixel(event), Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
    },
    pointerdown: (event) => {
      if (event.button !== 0) return;
      if (pointers.size === 0) {
        moved = 0;
        pressed = event.target;
      }
      pointers.set(event.pointerId, pixel(event));
      svg.setPointerCapture(event.pointerId);
    },
    pointermove: (event) => {
      const now = pixel(event);
      act.hover(now);
      const before = pointers.get(event.pointerId);
      if (!before) return;
      moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
      const wide = pointers.size === 2 && spread();
      pointers.set(event.pointerId, now);
      if (wide) {
        const after = spread();
        act.zoom(after.middle, after.distance / Math.max(wide.distance, 1));
        act.pan(after.middle[0] - wide.middle[0], after.middle[1] - wide.middle[1]);
      } else if (pointers.size === 1 && moved > TAP) act.pan(now[0] - before[0], now[1] - before[1]);
    },
    pointerup: (event) => {
      if (pointers.delete(event.pointerId) && pointers.size === 0 && moved <= TAP) act.tap(pixel(event), pressed);
    },
    pointercancel: (event) => pointers.delete(event.pointerId),
    pointerleave: () => act.hover(null),
  };
  for (const [name, listener] of Object.entries(listeners)) svg.addEventListener(name, listener, { passive: false });
  return () => Object.entries(listeners).forEach(([name, listener]) => svg.removeEventListener(name, listener));
}
