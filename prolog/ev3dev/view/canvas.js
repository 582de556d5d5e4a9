// What is drawn on a canvas again and again.

/** A path through points, on a canvas or as a Path2D. */
export function along(path, points, closed = false) {
  points.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
  if (closed) path.closePath();
}

export function trace(c, points, closed) {
  c.beginPath();
  along(c, points, closed);
}

export function disc(c, x, y, r) {
  c.beginPath();
  c.arc(x, y, r, 0, 7);
}

/** Without a path it is that of the canvas; also in `stroke`. */
export function fill(c, color, path) {
  c.fillStyle = color;
  if (path) c.fill(path);
  else c.fill();
}

export function stroke(c, color, width, path, dash = []) {
  [c.strokeStyle, c.lineWidth] = [color, width];
  c.setLineDash(dash);
  if (path) c.stroke(path);
  else c.stroke();
  c.setLineDash([]);
}
