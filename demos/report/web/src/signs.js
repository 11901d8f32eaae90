// The look of verdicts: each tone has its own sign, so that colour is never the only cue.
export const kSigns = { clear: "○", intended: "●", near: "▲", interference: "✖", open: "?" };
export const kColors = { clear: "#5c6675", intended: "#00694a", near: "#b87a00", interference: "#c9370c", open: "#6b3fa0" };

/** Draws the sign of a tone around a point of a 2-D canvas. */
export function drawSign(context, tone, x, y, size) {
  const r = size / 2;
  context.save();
  context.translate(x, y);
  context.fillStyle = kColors[tone];
  context.strokeStyle = kColors[tone];
  context.lineWidth = size / 4;
  context.lineCap = "round";
  context.beginPath();
  if (tone === "interference") {
    for (const [a, b] of [[-1, 1], [1, -1]]) { context.moveTo(-0.8 * r, a * 0.8 * r); context.lineTo(0.8 * r, b * 0.8 * r); }
    context.stroke();
  } else if (tone === "near") {
    context.moveTo(0, -r); context.lineTo(r, 0.8 * r); context.lineTo(-r, 0.8 * r); context.closePath();
    context.fill();
  } else if (tone === "open") {
    context.moveTo(0, -r); context.lineTo(r, 0); context.lineTo(0, r); context.lineTo(-r, 0); context.closePath();
    context.fill();
  } else {
    context.arc(0, 0, 0.75 * r, 0, 2 * Math.PI);
    if (tone === "clear") context.stroke(); else context.fill();
  }
  context.restore();
}

export function signSpan(tone) {
  const span = document.createElement("span");
  span.className = `sign tone-${tone}`;
  span.setAttribute("aria-hidden", "true");
  span.textContent = kSigns[tone];
  return span;
}
