// Parallel coordinates: what is drawn, what a brush chooses, and which line a pointer meets.

import { Inks, viridis } from "./canvas";
import { number } from "./format";
import { Cell } from "./types";

/// Answer of designs/d3/parameters: columns, a value a candidate.
export interface Sample {
  v: number;
  total: number;
  candidates: number[];
  iteration: number[];
  mean: (number | null)[];
  runs: number[];
  elite: (boolean | number)[];
  parameters: Record<string, Cell[]>;
}

/// A parameter's scale. Values of numbers lie between low and high; words stand evenly.
export interface Axis {
  name: string;
  values: Cell[];
  words: string[] | null;
  low: number;
  high: number;
}

/// From and to, as parts of the axis: 0 is its foot.
export interface Brush { from: number; to: number }

const kTop = 34, kFoot = 40, kSide = 74;

/// Whether candidates differ in it; those without a value count as one more.
export function varies(values: Cell[]): boolean {
  return values.some((value) => value !== values[0]);
}

export function axis_of(name: string, values: Cell[]): Axis {
  const known = values.filter((value) => value !== null);
  if (known.some((value) => typeof value !== "number")) {
    const words = [...new Set(known.map(String))].sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
    return { name, values, words, low: 0, high: Math.max(1, words.length - 1) };
  }
  let low = Infinity, high = -Infinity;
  for (const value of known as number[]) { low = Math.min(low, value); high = Math.max(high, value); }
  if (low > high) [low, high] = [0, 1];
  // Few whole numbers are words, too.
  if (high - low <= 8 && known.every(Number.isInteger)) {
    const words = Array.from({ length: high - low + 1 }, (_, i) => String(low + i));
    return { name, values, words, low: 0, high: Math.max(1, words.length - 1) };
  }
  if (low === high) [low, high] = [low - 0.5, high + 0.5];
  return { name, values, words: null, low, high };
}

/// A candidate's place on an axis, 0 to 1; null: it has no such parameter.
export function part_on(axis: Axis, candidate: number): number | null {
  const value = axis.values[candidate];
  if (value === null || value === undefined) return null;
  const at = axis.words ? axis.words.indexOf(String(value)) : value as number;
  return (at - axis.low) / (axis.high - axis.low);
}

export function text_at(axis: Axis, part: number): string {
  const value = axis.low + part * (axis.high - axis.low);
  return axis.words ? axis.words[Math.max(0, Math.min(axis.words.length - 1, Math.round(value)))] : number(value, 3);
}

/// Which candidates lie in all brushes.
export function chosen_by(axes: Axis[], brushes: Record<string, Brush>, count: number): boolean[] {
  const active = axes.filter(({ name }) => brushes[name]);
  return Array.from({ length: count }, (_, candidate) => active.every((axis) => {
    const part = part_on(axis, candidate);
    const { from, to } = brushes[axis.name];
    return part !== null && part >= from - 1e-9 && part <= to + 1e-9;
  }));
}

export interface Plot {
  axes: Axis[];
  /// 0 to 1 a candidate, null: nothing known.
  shade: (number | null)[];
  elite: (boolean | number)[];
  chosen: boolean[];
  brushes: Record<string, Brush>;
  /// Line under the pointer.
  met: number | null;
}

export function x_of(axes: Axis[], at: number, width: number): number {
  return axes.length < 2 ? width / 2 : kSide + at * (width - 2 * kSide) / (axes.length - 1);
}

/// Words get a little room each, so that lines do not all lie on each other.
function y_of(axis: Axis, candidate: number, height: number): number {
  const part = part_on(axis, candidate);
  if (part === null) return height - 12;
  const length = height - kTop - kFoot;
  const spread = axis.words ? Math.min(10, 0.3 * length / axis.words.length) * (((candidate * 0.618034) % 1) - 0.5) : 0;
  return kTop + (1 - part) * length + spread;
}

export function part_of_y(y: number, height: number): number {
  return Math.max(0, Math.min(1, 1 - (y - kTop) / (height - kTop - kFoot)));
}

/// The axis whose line a pointer is at; null: it is between two.
export function axis_at(axes: Axis[], x: number, width: number): number | null {
  for (let at = 0; at < axes.length; ++at) if (Math.abs(x_of(axes, at, width) - x) <= 9) return at;
  return null;
}

/// The candidate whose line passes nearest to a place, within some pixels.
export function line_at({ axes, chosen, elite }: Plot, x: number, y: number, width: number, height: number): number | null {
  if (axes.length < 2) return null;
  const step = (width - 2 * kSide) / (axes.length - 1);
  const at = Math.max(0, Math.min(axes.length - 2, Math.floor((x - kSide) / step)));
  const part = (x - x_of(axes, at, width)) / step;
  if (part < -0.1 || part > 1.1) return null;
  let best: number | null = null, nearest = 7;
  for (let candidate = 0; candidate < chosen.length; ++candidate) {
    if (!chosen[candidate]) continue;
    const here = (1 - part) * y_of(axes[at], candidate, height) + part * y_of(axes[at + 1], candidate, height);
    const distance = Math.abs(here - y) - (elite[candidate] ? 1 : 0);
    if (distance < nearest) { nearest = distance; best = candidate; }
  }
  return best;
}

export function draw_parallel(pen: CanvasRenderingContext2D, plot: Plot, width: number, height: number, inks: Inks, is_dark: boolean): void {
  const { axes, chosen, elite, shade } = plot;
  const count = chosen.length;
  const line = (candidate: number) => {
    pen.beginPath();
    axes.forEach((axis, at) => {
      const [x, y] = [x_of(axes, at, width), y_of(axis, candidate, height)];
      if (at === 0) pen.moveTo(x, y); else pen.lineTo(x, y);
    });
    pen.stroke();
  };
  pen.lineJoin = "round";
  pen.lineWidth = 1;
  pen.strokeStyle = inks.line;
  pen.globalAlpha = 0.25;
  for (let candidate = 0; candidate < count; ++candidate) if (!chosen[candidate]) line(candidate);
  pen.globalAlpha = count > 300 ? 0.45 : 0.75;
  for (let candidate = 0; candidate < count; ++candidate) {
    if (!chosen[candidate] || elite[candidate]) continue;
    const part = shade[candidate];
    pen.strokeStyle = part === null ? inks.faint : viridis(is_dark ? 1 - part : part);
    line(candidate);
  }
  pen.globalAlpha = 1;
  const bold = (candidate: number, color: string, thick: number) => {
    pen.strokeStyle = inks.paper;
    pen.lineWidth = thick + 2;
    line(candidate);
    pen.strokeStyle = color;
    pen.lineWidth = thick;
    line(candidate);
  };
  for (let candidate = 0; candidate < count; ++candidate) if (chosen[candidate] && elite[candidate]) bold(candidate, "#d55e00", 2);
  if (plot.met !== null) bold(plot.met, inks.ink, 3);
  axes.forEach((axis, at) => draw_axis(pen, axis, plot.brushes[axis.name], x_of(axes, at, width), at, height, inks));
}

function draw_axis(pen: CanvasRenderingContext2D, axis: Axis, brush: Brush | undefined, x: number, at: number, height: number, inks: Inks): void {
  const foot = height - kFoot, length = foot - kTop;
  pen.strokeStyle = inks.ink;
  pen.lineWidth = 1.25;
  pen.beginPath();
  pen.moveTo(x, kTop);
  pen.lineTo(x, foot);
  pen.stroke();
  if (brush) {
    const [top, bottom] = [kTop + (1 - brush.to) * length, kTop + (1 - brush.from) * length];
    pen.fillStyle = "rgba(0,114,178,.35)";
    pen.fillRect(x - 8, top - 1, 16, bottom - top + 2);
    pen.strokeStyle = inks.ink;
    pen.strokeRect(x - 8, top - 1, 16, bottom - top + 2);
  }
  pen.textAlign = "center";
  const write = (text: string, y: number, style: string, color: string, ground = false) => {
    pen.font = `${style} ${inks.font}`;
    if (ground) { pen.strokeStyle = inks.paper; pen.lineWidth = 4; pen.strokeText(text, x, y); }
    pen.fillStyle = color;
    pen.fillText(text, x, y);
  };
  pen.textBaseline = "alphabetic";
  // Neighbours' names stand at two heights, so that long ones have room.
  write(axis.name, at % 2 ? 12 : 24, "600 12px", inks.ink, true);
  pen.textBaseline = "middle";
  if (axis.words) axis.words.forEach((word, i) => write(word.replace(/_/g, " "), kTop + (1 - (i - axis.low) / (axis.high - axis.low)) * length, "11px", inks.ink, true));
  else for (const part of [0, 0.5, 1]) write(text_at(axis, part), kTop + (1 - part) * length, "11px", inks.ink, true);
  if (axis.values.some((value) => value === null || value === undefined)) write("not used", height - 12, "11px", inks.faint, true);
}
